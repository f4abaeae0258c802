// The plan in a few lines, and how this week stands.
import { readAdherence, readPlan } from "../../api/client";
import type { Plan } from "../../api/types";
import { t } from "../../strings";
import { gameName } from "../../strings/games";
import { figure } from "../format";
import { useAsked } from "../hooks";
import { sumOf } from "../plan/draft";
import { ProblemBox } from "../problem";
import { hrefOf } from "../route";

export function PlanCard({ id }: { id: number }) {
  const plan = useAsked(() => readPlan(id), id);
  return (
    <section class="card" data-testid="plan-card">
      <div class="heading">
        <h2>{t("patient.page.plan")}</h2>
        <a class="button" href={hrefOf({ page: "plan", id })} data-testid="open-plan">
          {t(plan.answered && !plan.value ? "plan.make" : "plan.look")}
        </a>
      </div>
      <ProblemBox problem={plan.problem} onRetry={plan.again} />
      {plan.answered && !plan.value && <p class="soft">{t("plan.none")}</p>}
      {plan.value && <InShort plan={plan.value} />}
    </section>
  );
}

function InShort({ plan }: { plan: Plan }) {
  const week = useAsked(() => readAdherence(plan.patient_id, 1), plan.updated_at).value?.weeks[0];
  const { minutes } = sumOf(plan);
  return (
    <>
      <p>
        {plan.exercises.map((exercise) => `${gameName(exercise.game)} ${figure(exercise.minutes)} min`).join(" · ")}
      </p>
      <p class="soft">
        {t("plan.in-short", { minutes: figure(minutes), perWeek: plan.sessions_per_week, weeks: plan.weeks })}
      </p>
      {week && (
        <p data-testid="this-week">
          <strong>{t("plan.this-week", { done: week.done, planned: week.planned })}</strong>
        </p>
      )}
    </>
  );
}
