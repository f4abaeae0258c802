// From "who is there" to "ready": the wizard that opens a session, with live pictures at every step.
import { currentSession, readPatient, readPlan } from "../../api/client";
import { useAsked } from "../hooks";
import type { Feed } from "../live/feed";
import { ProblemBox } from "../problem";
import { StopBar } from "../stop/bar";
import { Wizard } from "./wizard";
import "./wizard.css";

interface Props {
  id: number;
  feed: Feed;
  account: string;
}

export function WizardPage({ id, feed, account }: Props) {
  const patient = useAsked(() => readPatient(id), id);
  const plan = useAsked(() => readPlan(id), id);
  const current = useAsked(currentSession, id);
  const isOwn = current.value?.patient_id === id;
  return (
    <>
      <main class="wizard" data-testid="wizard">
        <ProblemBox problem={patient.problem} onRetry={patient.again} />
        <ProblemBox problem={plan.problem} onRetry={plan.again} />
        <ProblemBox problem={current.problem} onRetry={current.again} />
        {patient.value && plan.answered && current.answered && (
          <Wizard
            patient={patient.value}
            plan={plan.value}
            session={current.value}
            feed={feed}
            account={account}
            onSigned={patient.again}
            onOpened={current.again}
          />
        )}
      </main>
      {!isOwn && <StopBar feed={feed} />}
    </>
  );
}
