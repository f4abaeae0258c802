// Scores of standard tests: entered with day and rater, listed, taken back after a question.
import { listScores, readPatient, readStatus } from "../../api/client";
import { otherSide } from "../../api/types";
import { t } from "../../strings";
import { useAsked } from "../hooks";
import { PatientTabs } from "../patient/tabs";
import { ProblemBox } from "../problem";
import { ScoreFields } from "./form";
import { ScoreList } from "./list";
import "./scores.css";

export function ScoresPage({ id }: { id: number }) {
  const patient = useAsked(() => readPatient(id), id);
  const scores = useAsked(() => listScores(id), id);
  const status = useAsked(readStatus, "who");
  const again = () => {
    for (const asked of [patient, scores, status]) asked.again();
  };
  return (
    <main class="page" data-testid="scores">
      <h1>{patient.value?.name ?? ""}</h1>
      <PatientTabs id={id} at="scores" />
      <ProblemBox problem={patient.problem ?? scores.problem ?? status.problem} onRetry={again} />
      <div class="columns">
        {patient.value && status.value && (
          <ScoreFields
            id={id}
            affected={otherSide(patient.value.healthy_side)}
            rater={status.value.account?.name ?? ""}
            onAdded={scores.again}
          />
        )}
        {scores.value && (
          <section class="card">
            <h2>{t("scores.title")}</h2>
            <ScoreList id={id} scores={scores.value} onRemoved={scores.again} />
          </section>
        )}
      </div>
    </main>
  );
}
