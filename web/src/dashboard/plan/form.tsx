// The plan as a form.
import { useState } from "preact/hooks";
import { putPlan } from "../../api/client";
import type { Plan } from "../../api/types";
import { t } from "../../strings";
import { dateAndTime, dateText, figure, isoDay } from "../format";
import { useDoing } from "../hooks";
import { NumberField, wholeIn } from "../number-field";
import { ProblemBox } from "../problem";
import { formOf, MOST_PER_WEEK, MOST_REPETITIONS, MOST_WEEKS, type PlanDraft, repetitionsOf, sumOf } from "./draft";
import { ExerciseFields } from "./exercise-fields";

interface Props {
  id: number;
  first: PlanDraft;
  games: readonly string[];
  saved: Plan | null;
  onSaved: () => void;
}

export function PlanFields({ id, first, games, saved, onSaved }: Props) {
  const [draft, setDraft] = useState(first);
  const doing = useDoing();
  const change = (part: Partial<PlanDraft>) => setDraft((before) => ({ ...before, ...part }));
  const form = formOf(draft);
  const submit = (event: Event) => {
    event.preventDefault();
    if (form) doing.run(() => putPlan(id, form).then(onSaved));
  };
  return (
    <form class="card-form" noValidate onSubmit={submit}>
      <ExerciseFields exercises={draft.exercises} games={games} onChange={(exercises) => change({ exercises })} />
      <Often draft={draft} change={change} />
      <ProblemBox problem={doing.problem} onClose={doing.forget} />
      <div class="row">
        <button type="submit" class="primary big" disabled={doing.busy || !form} data-testid="save-plan">
          {t("plan.save")}
        </button>
        <p role="status" class="soft" data-testid="plan-sum">
          {form ? <Sum draft={draft} /> : t("plan.incomplete")}
          {saved && (
            <span class="small" data-testid="plan-saved">
              {" "}
              {t("plan.saved", { name: saved.updated_by, when: dateAndTime(saved.updated_at) })}
            </span>
          )}
        </p>
      </div>
    </form>
  );
}

function Sum({ draft }: { draft: PlanDraft }) {
  const form = formOf(draft);
  if (!form) return null;
  const { sessions, minutes, lastDay } = sumOf(form);
  return (
    <strong>
      {t("plan.sum", {
        sessions,
        minutes: figure(minutes, Number.isInteger(minutes) ? 0 : 1),
        until: dateText(isoDay(lastDay)),
      })}
    </strong>
  );
}

function Often({ draft, change }: { draft: PlanDraft; change: (part: Partial<PlanDraft>) => void }) {
  const outside = (text: string, most: number) =>
    wholeIn(text, 1, most) === null ? t("plan.between", { least: 1, most }) : "";
  return (
    <section class="card">
      <h2>{t("plan.often")}</h2>
      <div class="plan-often">
        <NumberField
          name={t("plan.per-week")}
          min={1}
          max={MOST_PER_WEEK}
          value={draft.perWeek}
          wrong={outside(draft.perWeek, MOST_PER_WEEK)}
          onInput={(perWeek) => change({ perWeek })}
          testId="plan-per-week"
        />
        <NumberField
          name={t("plan.weeks")}
          min={1}
          max={MOST_WEEKS}
          value={draft.weeks}
          wrong={outside(draft.weeks, MOST_WEEKS)}
          onInput={(weeks) => change({ weeks })}
          testId="plan-weeks"
        />
        <label>
          {t("plan.starts-on")}
          <input
            type="date"
            required
            value={draft.startsOn}
            onInput={(event) => change({ startsOn: event.currentTarget.value })}
            data-testid="plan-starts-on"
          />
        </label>
        <NumberField
          name={t("plan.repetitions")}
          min={1}
          max={MOST_REPETITIONS}
          value={draft.repetitions}
          wrong={repetitionsOf(draft) === undefined ? t("plan.between", { least: 1, most: MOST_REPETITIONS }) : ""}
          onInput={(repetitions) => change({ repetitions })}
          testId="plan-repetitions"
        />
      </div>
      <label>
        {t("plan.note")}
        <textarea
          maxLength={10_000}
          value={draft.note}
          onInput={(event) => change({ note: event.currentTarget.value })}
          data-testid="plan-note"
        />
      </label>
    </section>
  );
}
