// What the therapist answers before a session is open.
import type { Assistance, Exercise, Patient, SessionOpen, Side } from "../../api/types";
import type { Choice } from "./choice";

export interface Answers {
  side: Side | null;
  painBefore: number | null;
  assistance: Assistance;
  /** 0..1: the most help. */
  help: number;
  /** Today's programme. */
  exercises: readonly Exercise[];
  /** Who of several people is the patient. */
  choice: Choice | null;
}

export type Answer = (given: Partial<Answers>) => void;

/** What is played where there is no plan, as the service has it too. */
const WITHOUT_A_PLAN: readonly Exercise[] = [{ game: "reach", minutes: 6, level: null, pinned: false }];

/** Pre-filled from the patient's page and plan; the side is never: somebody must look. */
export function firstAnswers(patient: Patient, planned: readonly Exercise[] | null): Answers {
  return {
    side: null,
    painBefore: null,
    assistance: patient.assistance ?? "passive",
    help: patient.assist_level_most ?? 1,
    exercises: planned ?? WITHOUT_A_PLAN,
    choice: null,
  };
}

/** The form that opens the session; null while the side has not been confirmed. */
export function formOf(patient: Patient, answers: Answers): SessionOpen | null {
  if (answers.side === null) return null;
  return {
    patient_id: patient.id,
    confirmed_affected_side: answers.side,
    pain_before: answers.painBefore,
    exercises: [...answers.exercises],
    assistance: answers.assistance,
    assist_level: answers.help,
  };
}
