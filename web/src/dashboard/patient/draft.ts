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

/** What a relaxed adult arm allows, cautiously: the same as `PassiveRange` in the service. */
const CAUTIOUS_DEG: Record<Joint, readonly [number, number]> = {
  plane: [-20, 120],
  elevation: [0, 100],
  rotation: [-60, 80],
  elbow: [0, 135],
};

export const LARGEST_DEG = 180;

export function emptyDraft(): Draft {
  return { name: "", healthySide: null, notes: "", range: eachJoint((joint) => asText(...CAUTIOUS_DEG[joint])) };
}

export function draftOf(patient: Patient): Draft {
  const known = patient.passive_range;
  return {
    name: patient.name,
    healthySide: patient.healthy_side,
    notes: patient.notes,
    range: eachJoint((joint) => {
      const range = known?.[joint];
      return range ? asText(degrees(range.min_rad), degrees(range.max_rad)) : asText(...CAUTIOUS_DEG[joint]);
    }),
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

function asText(min: number, max: number): RangeDraft {
  return { min: String(Math.round(min)), max: String(Math.round(max)) };
}

function eachJoint<T>(make: (joint: Joint) => T): Record<Joint, T> {
  return { plane: make("plane"), elevation: make("elevation"), rotation: make("rotation"), elbow: make("elbow") };
}
