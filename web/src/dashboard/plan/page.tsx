// A patient's plan: what is played in a session, how often, for how long, and how much of it was done.
import { listGames, readPatient, readPlan } from "../../api/client";
import { t } from "../../strings";
import { useAsked } from "../hooks";
import { PatientTabs } from "../patient/tabs";
import { ProblemBox } from "../problem";
import { Calendar } from "./calendar";
import { draftOf, newDraft } from "./draft";
import { PlanFields } from "./form";
import "./plan.css";

export function PlanPage({ id }: { id: number }) {
  const patient = useAsked(() => readPatient(id), id);
  const plan = useAsked(() => readPlan(id), id);
  const games = useAsked(listGames, "games");
  const again = () => {
    for (const asked of [patient, plan, games]) asked.again();
  };
  return (
    <main class="page" data-testid="plan">
      <h1>{patient.value?.name ?? ""}</h1>
      <PatientTabs id={id} at="plan" />
      <ProblemBox problem={patient.problem ?? plan.problem ?? games.problem} onRetry={again} />
      {plan.answered && games.value && (
        <>
          {!plan.value && <p class="notice">{t("plan.none")}</p>}
          <PlanFields
            key={plan.value?.updated_at ?? "new"}
            id={id}
            first={plan.value ? draftOf(plan.value) : newDraft(new Date())}
            games={games.value.map(({ name }) => name)}
            saved={plan.value}
            onSaved={plan.again}
          />
          {plan.value && <Calendar key={plan.value.updated_at} plan={plan.value} />}
        </>
      )}
    </main>
  );
}
