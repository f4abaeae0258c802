// Entering a score.
import { useState } from "preact/hooks";
import { addScore } from "../../api/client";
import type { Side } from "../../api/types";
import { t } from "../../strings";
import { isoDay } from "../format";
import { useDoing } from "../hooks";
import { NumberField } from "../number-field";
import { ProblemBox } from "../problem";
import { emptyDraft, formOf, isOffScale, isOn, type ScoreDraft } from "./draft";
import { GREATEST, KINDS } from "./scales";

interface Props {
  id: number;
  affected: Side;
  /** Who is logged in; who did the test may be somebody else. */
  rater: string;
  onAdded: () => void;
}

export function ScoreFields({ id, affected, rater, onAdded }: Props) {
  const today = new Date();
  const [draft, setDraft] = useState(() => emptyDraft(affected, rater, today));
  const doing = useDoing();
  const change = (part: Partial<ScoreDraft>) => setDraft((before) => ({ ...before, ...part }));
  const form = formOf(draft, today);
  const submit = (event: Event) => {
    event.preventDefault();
    if (!form) return;
    doing.run(async () => {
      await addScore(id, form);
      change({ value: "", note: "" });
      onAdded();
    });
  };
  return (
    <form class="card" noValidate onSubmit={submit}>
      <h2>{t("scores.new")}</h2>
      <KindField draft={draft} change={change} />
      <SideField draft={draft} change={change} affected={affected} />
      <NumberField
        name={t("scores.value", { most: GREATEST[draft.kind] })}
        min={0}
        max={GREATEST[draft.kind]}
        value={draft.value}
        wrong={
          isOffScale(draft) ? t("scores.off-scale", { name: t(`score.${draft.kind}`), most: GREATEST[draft.kind] }) : ""
        }
        onInput={(value) => change({ value })}
        testId="score-value"
      />
      <DayAndRater draft={draft} change={change} today={today} />
      <ProblemBox problem={doing.problem} onClose={doing.forget} />
      <div class="row">
        <button type="submit" class="primary" disabled={doing.busy || !form} data-testid="save-score">
          {t("scores.save")}
        </button>
        {!form && <span class="small soft">{t("scores.incomplete")}</span>}
      </div>
    </form>
  );
}

interface PartProps {
  draft: ScoreDraft;
  change: (part: Partial<ScoreDraft>) => void;
}

function KindField({ draft, change }: PartProps) {
  return (
    <div class="field">
      <span id="score-kind">{t("scores.kind")}</span>
      <fieldset class="choices" aria-labelledby="score-kind">
        {KINDS.map((kind) => (
          <button
            key={kind}
            type="button"
            class="choice choice-low"
            aria-pressed={draft.kind === kind}
            onClick={() => change({ kind })}
            data-testid={`score-${kind}`}
          >
            {t(`score.${kind}`)}
          </button>
        ))}
      </fieldset>
      <span class="hint">{t(`score.${draft.kind}.what`)}</span>
    </div>
  );
}

function SideField({ draft, change, affected }: PartProps & { affected: Side }) {
  return (
    <div class="field">
      <span id="score-side">{t("scores.side")}</span>
      <fieldset class="choices" aria-labelledby="score-side">
        {(["left", "right"] as const).map((side) => (
          <button
            key={side}
            type="button"
            class="choice choice-low"
            aria-pressed={draft.side === side}
            onClick={() => change({ side })}
            data-testid={`score-side-${side}`}
          >
            {t(`side.${side}`)} ({t(side === affected ? "arm.affected.short" : "arm.healthy.short")})
          </button>
        ))}
      </fieldset>
    </div>
  );
}

function DayAndRater({ draft, change, today }: PartProps & { today: Date }) {
  return (
    <>
      <div class="scores-pair">
        <label>
          {t("scores.on")}
          <input
            type="date"
            required
            max={isoDay(today)}
            value={draft.on}
            onInput={(event) => change({ on: event.currentTarget.value })}
            data-testid="score-on"
          />
          {!isOn(draft.on, today) && <span class="small caveat">⚠ {t("scores.on.wrong")}</span>}
        </label>
        <label>
          {t("scores.rater")}
          <input
            required
            maxLength={80}
            value={draft.rater}
            onInput={(event) => change({ rater: event.currentTarget.value })}
            data-testid="score-rater"
          />
        </label>
      </div>
      <label>
        {t("scores.note")}
        <input
          maxLength={2000}
          value={draft.note}
          onInput={(event) => change({ note: event.currentTarget.value })}
          data-testid="score-note"
        />
      </label>
    </>
  );
}
