// How much of the movement is the drive's: three ways of helping and, where help follows need, how much at most.
import { useState } from "preact/hooks";
import { setAssistance } from "../../../api/client";
import { ASSISTANCE, type Assistance } from "../../../api/types";
import { t } from "../../../strings";
import { useDoing } from "../../hooks";
import { LevelSlider } from "../../level-slider";
import { ProblemBox } from "../../problem";
import { type Feed, useFromFeed } from "../feed";
import "./help.css";

interface Props {
  feed: Feed;
  session: number;
  isMine: boolean;
}

export function Help({ feed, session, isMine }: Props) {
  const now = useFromFeed(feed, 5, ({ newest }) => newest?.tick.exo.assistance ?? "passive");
  const level = useFromFeed(feed, 5, ({ newest }) => newest?.tick.exo.level ?? 1);
  const most = useFromFeed(feed, 1, ({ newest }) => newest?.session?.assist_level_most ?? 1);
  const doing = useDoing();
  const [wanted, setWanted] = useState<Assistance | null>(null);
  const change = (mode: Assistance, nextLevel: number) => {
    setWanted(mode);
    doing.run(async () => {
      await setAssistance(session, mode, nextLevel);
    });
  };
  return (
    <fieldset class="help" aria-label={t("help.title")} data-testid="help" data-mode={now}>
      {ASSISTANCE.map((mode) => (
        <button
          key={mode}
          type="button"
          aria-pressed={now === mode}
          aria-busy={doing.busy && wanted === mode}
          disabled={!isMine}
          title={t(`help.${mode}.means`)}
          onClick={() => change(mode, Math.min(level, most))}
          data-testid={`help-${mode}`}
        >
          {now === mode ? "✓ " : ""}
          {t(`help.${mode}`)}
        </button>
      ))}
      {now === "assisted" ? (
        <LevelSlider level={level} most={most} disabled={!isMine} onChange={(next) => change("assisted", next)} />
      ) : (
        <span class="help-means small">{t(`help.${now}.means`)}</span>
      )}
      <ProblemBox problem={doing.problem} onClose={doing.forget} />
    </fieldset>
  );
}
