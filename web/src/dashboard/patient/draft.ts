// A patient as the form holds it: angles in degrees, as text, until they can be sent.
import { JOINTS, type Joint, type PassiveRange, type Patient, type PatientForm, type Side } from "../../api/types";
import { degrees, radians } from "../format";

export interface RangeDraft {
  min: string;
  max: string;
}

export interface Draft {
  name: string;
  healthySide: Side | null;
  notes: string;
  range: Record<Joint, RangeDraft>;
}

export const LARGEST_DEG = 180;

/** A form for somebody of whom only the range to begin with is known. */
export function emptyDraft(range: PassiveRange): Draft {
  return { name: "", healthySide: null, notes: "", range: asDrafts(range) };
}

export function draftOf(patient: Patient): Draft {
  return {
    name: patient.name,
    healthySide: patient.healthy_side,
    notes: patient.notes,
    range: asDrafts(patient.passive_range),
  };
}

/** Both ends as numbers, or null where they do not make a range. */
export function rangeDeg(range: RangeDraft): readonly [number, number] | null {
  if (range.min.trim() === "" || range.max.trim() === "") return null;
  const [min, max] = [Number(range.min), Number(range.max)];
  const usable = min < max && min >= -LARGEST_DEG && max <= LARGEST_DEG;
  return usable ? [min, max] : null;
}

/** What is sent, or null while something is missing or does not make sense. */
export function formOf(draft: Draft): PatientForm | null {
  if (!draft.name.trim() || !draft.healthySide) return null;
  const passiveRange: Partial<PassiveRange> = {};
  for (const joint of JOINTS) {
    const range = rangeDeg(draft.range[joint]);
    if (!range) return null;
    passiveRange[joint] = { min_rad: radians(range[0]), max_rad: radians(range[1]) };
  }
  return {
    name: draft.name.trim(),
    healthy_side: draft.healthySide,
    notes: draft.notes,
    passive_range: passiveRange as PassiveRange,
  };
}

function asDrafts(range: PassiveRange | undefined): Record<Joint, RangeDraft> {
  return eachJoint((joint) => ({ min: inDegrees(range?.[joint]?.min_rad), max: inDegrees(range?.[joint]?.max_rad) }));
}

function inDegrees(angleRad: number | undefined): string {
  return angleRad === undefined ? "" : String(Math.round(degrees(angleRad)));
}

function eachJoint<T>(make: (joint: Joint) => T): Record<Joint, T> {
  return { plane: make("plane"), elevation: make("elevation"), rotation: make("rotation"), elbow: make("elbow") };
}
