// How a patient gets on: each figure over the sessions with what may be chance, the arms' range, scores on the same days.
import { listScores, readPatient, readProgress } from "../../api/client";
import { otherSide, type Progress, type Score, type Side } from "../../api/types";
import { t } from "../../strings";
import { useAsked } from "../hooks";
import { PatientTabs } from "../patient/tabs";
import { ProblemBox } from "../problem";
import { ArmRanges } from "./arm-ranges";
import { daysOf } from "./days";
import { FigureCard } from "./figure-card";
import { familiesOf } from "./lines";
import { ScoreCard } from "./score-strip";
import { AllFigures } from "./table";
import "./progress.css";

export function ProgressPage({ id }: { id: number }) {
  const patient = useAsked(() => readPatient(id), id);
  const progress = useAsked(() => readProgress(id), id);
  const scores = useAsked(() => listScores(id), id);
  const again = () => {
    for (const asked of [patient, progress, scores]) asked.again();
  };
  return (
    <main class="page" data-testid="progress">
      <h1>{patient.value?.name ?? ""}</h1>
      <PatientTabs id={id} at="progress" />
      <ProblemBox problem={patient.problem ?? progress.problem ?? scores.problem} onRetry={again} />
      {patient.value && progress.value && scores.value && (
        <Shown progress={progress.value} scores={scores.value} affected={otherSide(patient.value.healthy_side)} />
      )}
    </main>
  );
}

interface ShownProps {
  progress: Progress;
  scores: readonly Score[];
  affected: Side;
}

function Shown({ progress, scores, affected }: ShownProps) {
  const families = familiesOf(progress.lines);
  const days = daysOf(progress.lines, scores);
  return (
    <>
      {families.length === 0 && <p class="notice">{t("progress.none")}</p>}
      {families.length > 0 && <FigureCard families={families} affected={affected} days={days} />}
      {scores.length > 0 && <ScoreCard scores={scores} days={days} affected={affected} />}
      <ArmRanges lines={progress.lines} affected={affected} />
      {families.length > 0 && <AllFigures families={families} affected={affected} />}
    </>
  );
}
