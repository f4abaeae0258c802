// Who is in charge, and taking over: an act of its own, confirmed where somebody else is there.
import { useState } from "preact/hooks";
import { takeAuthority } from "../../api/client";
import { t } from "../../strings";
import { useDoing } from "../hooks";
import { ProblemBox } from "../problem";
import { authorityOf, type Charge } from "./charge";
import { type Feed, useFromFeed } from "./feed";
import "./authority.css";

interface Props {
  feed: Feed;
  charge: Charge;
  session: number;
  account: string;
}

export function Authority({ feed, charge, session, account }: Props) {
  const holder = useFromFeed(feed, 4, ({ newest }) => authorityOf(newest)?.account ?? "");
  const isKnown = useFromFeed(feed, 5, ({ link }) => link === "open");
  const [asking, setAsking] = useState(false);
  // Nothing is left to confirm once the other page is gone.
  const isAsked = asking && charge === "other";
  const doing = useDoing();
  const take = (confirmed: boolean) =>
    doing.run(async () => {
      await takeAuthority(session, confirmed);
      setAsking(false);
    });
  if (!isKnown) return <div class="authority">{t("authority.unknown")}</div>;
  return (
    <div class="authority" data-testid="authority" data-charge={charge}>
      <Sign charge={charge} />
      {!isAsked && <span>{wordsFor(charge, holder, account)}</span>}
      {charge !== "mine" && !isAsked && (
        <button
          type="button"
          disabled={doing.busy}
          onClick={() => (charge === "other" ? setAsking(true) : take(false))}
          data-testid="take-over"
        >
          {t("authority.take")}
        </button>
      )}
      {isAsked && (
        <Question holder={holder} busy={doing.busy} onTake={() => take(true)} onCancel={() => setAsking(false)} />
      )}
      <ProblemBox problem={doing.problem} onClose={doing.forget} />
    </div>
  );
}

interface QuestionProps {
  holder: string;
  busy: boolean;
  onTake: () => void;
  onCancel: () => void;
}

function Question({ holder, busy, onTake, onCancel }: QuestionProps) {
  return (
    <div class="authority-question" role="alertdialog" aria-label={t("authority.take")}>
      <span>{t("authority.question", { name: holder })}</span>
      <button type="button" class="primary" disabled={busy} onClick={onTake} data-testid="confirm-take">
        {t("authority.confirm")}
      </button>
      <button type="button" disabled={busy} onClick={onCancel}>
        {t("action.cancel")}
      </button>
    </div>
  );
}

/** A filled head is here, a hollow one is somebody else's, a dotted one is gone. */
function Sign({ charge }: { charge: Charge }) {
  return (
    <svg class={`authority-sign authority-${charge}`} viewBox="0 0 20 20" aria-hidden="true">
      <path d="M10 2 a4 4 0 1 1 -0.01 0 M3 18 a7 7 0 0 1 14 0 Z" />
    </svg>
  );
}

function wordsFor(charge: Charge, holder: string, account: string): string {
  if (charge === "mine") return t("authority.mine");
  if (charge === "gone") return holder ? t("authority.gone", { name: holder }) : t("authority.nobody");
  return holder === account ? t("authority.other-page") : t("authority.other", { name: holder });
}
