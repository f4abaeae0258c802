// What a step asks and says, one function for each.
import type { ComponentChildren } from "preact";
import type { Patient, Plan, Session, SessionWorkspace } from "../../api/types";
import { t } from "../../strings";
import type { Feed } from "../live/feed";
import type { Person } from "../live/people";
import { LimitsCard } from "../patient/limits-card";
import type { Answer, Answers } from "./answers";
import { AlignmentStep } from "./step-alignment";
import { ArmStep } from "./step-arm";
import { PersonStep } from "./step-person";
import { RangeStep } from "./step-range";
import { ReadyStep } from "./step-ready";
import { SensorsStep } from "./step-sensors";
import type { Facts, Step } from "./steps";

export interface StepProps {
  facts: Facts;
  patient: Patient;
  plan: Plan | null;
  /** This patient's open session. */
  session: Session | null;
  feed: Feed;
  answers: Answers;
  answer: Answer;
  onChoose: (person: Person) => void;
  onSigned: () => void;
  /** Of the open session. */
  workspace: SessionWorkspace | null;
  onTaken: () => void;
}

const VIEWS: Record<Step, (props: StepProps) => ComponentChildren> = {
  sensors: ({ facts }) => <SensorsStep facts={facts} />,
  person: ({ facts, patient, onChoose }) => <PersonStep facts={facts} patient={patient} onChoose={onChoose} />,
  alignment: ({ facts }) => <AlignmentStep facts={facts} />,
  arm: (props) => <ArmStep {...props} />,
  limits: ({ patient, onSigned }) => <LimitsCard patient={patient} onConfirmed={onSigned} />,
  range: (props) => <RangeStep {...props} />,
  ready: (props) => <ReadyStep {...props} />,
};

/** Steps that say what the stream shows. */
const LIVE: readonly Step[] = ["sensors", "person", "alignment"];

export function StepView({ step, ...props }: StepProps & { step: Step }) {
  return (
    <>
      <h2 aria-live="polite">{t(`wizard.${step}.title`)}</h2>
      {props.facts.isConnected || !LIVE.includes(step) ? VIEWS[step](props) : <p role="status">… {t("wizard.lost")}</p>}
    </>
  );
}
