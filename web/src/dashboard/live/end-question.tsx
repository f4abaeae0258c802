// Ending a session: how much it hurts now, then the figures.
import { useEffect, useRef, useState } from "preact/hooks";
import { endSession } from "../../api/client";
import { t } from "../../strings";
import { useDoing } from "../hooks";
import { ProblemBox } from "../problem";
import { go } from "../route";
import { PainScale } from "../session/pain-scale";

interface Props {
  session: number;
  onCancel: () => void;
}

export function EndQuestion({ session, onCancel }: Props) {
  const [pain, setPain] = useState<number | null>(null);
  const doing = useDoing();
  const card = useRef<HTMLDivElement>(null);
  useEffect(() => card.current?.focus(), []);
  const end = () =>
    doing.run(async () => {
      const ended = await endSession(session, pain);
      go({ page: "summary", id: ended.id });
    });
  return (
    <div class="over">
      <div class="card" role="dialog" aria-modal="true" aria-label={t("session.end")} tabIndex={-1} ref={card}>
        <h2>{t("end.pain")}</h2>
        <PainScale value={pain} onChange={setPain} />
        <ProblemBox problem={doing.problem} onClose={doing.forget} />
        <div class="row">
          <button type="button" class="primary big" disabled={doing.busy} onClick={end} data-testid="confirm-end">
            {doing.busy ? t("end.saving") : t("end.confirm")}
          </button>
          <button type="button" disabled={doing.busy} onClick={onCancel}>
            {t("end.back")}
          </button>
          <span class="soft">{t("end.skippable")}</span>
        </div>
      </div>
    </div>
  );
}
