// A score as the form holds it.
import type { ScoreForm, Side } from "../../api/types";
import { isoDay } from "../format";
import { wholeIn } from "../number-field";
import { GREATEST, type Kind } from "./scales";

export interface ScoreDraft {
  kind: Kind;
  side: Side;
  value: string;
  on: string;
  rater: string;
  note: string;
}

export function emptyDraft(side: Side, rater: string, today: Date): ScoreDraft {
  return { kind: "fugl-meyer-ue", side, value: "", on: isoDay(today), rater, note: "" };
}

/** What is sent, or null while something is missing or off its scale. */
export function formOf(draft: ScoreDraft, today: Date): ScoreForm | null {
  const value = wholeIn(draft.value, 0, GREATEST[draft.kind]);
  if (value === null || !draft.rater.trim() || !isOn(draft.on, today)) return null;
  return { ...draft, value, rater: draft.rater.trim() };
}

/** Whether a day has been, or is today; a test cannot have been done tomorrow. */
export function isOn(day: string, today: Date): boolean {
  return day !== "" && day <= isoDay(today);
}

/** Whether something was typed that is off the scale; an empty field is not wrong yet. */
export function isOffScale({ kind, value }: Pick<ScoreDraft, "kind" | "value">): boolean {
  return value.trim() !== "" && wholeIn(value, 0, GREATEST[kind]) === null;
}
