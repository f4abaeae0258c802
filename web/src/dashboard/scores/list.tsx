// The scores of a patient, newest first.
import { useState } from "preact/hooks";
import { removeScore } from "../../api/client";
import type { Score } from "../../api/types";
import { t } from "../../strings";
import { dateText } from "../format";
import { useDoing } from "../hooks";
import { ProblemBox } from "../problem";
import { GREATEST } from "./scales";

interface Props {
  id: number;
  scores: readonly Score[];
  onRemoved: () => void;
}

export function ScoreList({ id, scores, onRemoved }: Props) {
  const [asked, setAsked] = useState<number | null>(null);
  const doing = useDoing();
  const remove = (number: number) =>
    doing.run(async () => {
      await removeScore(id, number);
      setAsked(null);
      onRemoved();
    });
  if (scores.length === 0) return <p class="soft">{t("scores.none")}</p>;
  return (
    <>
      <ProblemBox problem={doing.problem} onClose={doing.forget} />
      <ul class="scores-list">
        {[...scores].reverse().map((score) => (
          <li key={score.id} data-testid="score-row" data-kind={score.kind}>
            <Said score={score} />
            {asked === score.id ? (
              <Question busy={doing.busy} onYes={() => remove(score.id)} onNo={() => setAsked(null)} />
            ) : (
              <button
                type="button"
                aria-label={t("scores.remove.of", { name: t(`score.${score.kind}`), day: dateText(score.on) })}
                onClick={() => setAsked(score.id)}
                data-testid="remove-score"
              >
                {t("scores.remove")}
              </button>
            )}
          </li>
        ))}
      </ul>
    </>
  );
}

function Said({ score }: { score: Score }) {
  return (
    <div>
      <strong>
        {t(`score.${score.kind}`)}: {score.value} / {GREATEST[score.kind]}
      </strong>
      <div class="small soft">
        {t("scores.who", { day: dateText(score.on), side: t(`side.${score.side}`), rater: score.rater })}
      </div>
      {score.note && <div class="small">{score.note}</div>}
    </div>
  );
}

/** A score taken back is gone, so it is asked once more. */
function Question({ busy, onYes, onNo }: { busy: boolean; onYes: () => void; onNo: () => void }) {
  return (
    <div class="notice scores-question" role="alertdialog" aria-label={t("scores.remove.question")}>
      <p>{t("scores.remove.question")}</p>
      <div class="row">
        <button type="button" ref={focusOnce} disabled={busy} onClick={onNo} data-testid="keep-score">
          {t("scores.remove.no")}
        </button>
        <button type="button" class="primary" disabled={busy} onClick={onYes} data-testid="confirm-remove-score">
          {t("scores.remove.yes")}
        </button>
      </div>
    </div>
  );
}

/** The button that was pressed is gone: the keyboard goes on at the harmless answer. */
function focusOnce(button: HTMLButtonElement | null): void {
  button?.focus();
}
