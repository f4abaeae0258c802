// A patient as the form holds it: degrees, newton metres and percent, as text, until they can be sent.
import {
  type Assistance,
  type ForceLimits,
  JOINTS,
  type Joint,
  type PassiveRange,
  type Patient,
  type PatientForm,
  type PatientLimits,
  type Side,
} from "../../api/types";
import { degrees, radians } from "../format";

/** What one joint may do. */
export interface JointDraft {
  min: string;
  max: string;
  torque: string;
  resistance: string;
}

export interface Draft {
  name: string;
  healthySide: Side | null;
  notes: string;
  joints: Record<Joint, JointDraft>;
  assistance: Assistance;
  /** The most help while assisted, 0..1. */
  most: number;
}

export const LARGEST_DEG = 180;
export const LARGEST_NM = 60;

/** A form for somebody of whom only the limits to begin with are known. */
export function emptyDraft(limits: PatientLimits): Draft {
  return {
    name: "",
    healthySide: null,
    notes: "",
    joints: asDrafts(limits),
    assistance: "passive",
    most: limits.assist_level_most ?? 1,
  };
}

export function draftOf(patient: Patient): Draft {
  return {
    name: patient.name,
    healthySide: patient.healthy_side,
    notes: patient.notes,
    joints: asDrafts(patient),
    assistance: patient.assistance ?? "passive",
    most: patient.assist_level_most ?? 1,
  };
}

/** Both ends as numbers, or null where they do not make a range. */
export function rangeDeg({ min, max }: Pick<JointDraft, "min" | "max">): readonly [number, number] | null {
  if (min.trim() === "" || max.trim() === "") return null;
  const [low, high] = [Number(min), Number(max)];
  const usable = low < high && low >= -LARGEST_DEG && high <= LARGEST_DEG;
  return usable ? [low, high] : null;
}

/** Newton metres, or null where they are none. */
export function torqueNm(text: string): number | null {
  const torque = Number(text);
  return text.trim() !== "" && torque > 0 && torque <= LARGEST_NM ? torque : null;
}

/** What is sent, or null while something is missing or does not make sense. */
export function formOf(draft: Draft): PatientForm | null {
  if (!draft.name.trim() || !draft.healthySide) return null;
  const passiveRange: Partial<PassiveRange> = {};
  const forceLimits: Partial<ForceLimits> = {};
  for (const joint of JOINTS) {
    const { torque, resistance } = draft.joints[joint];
    const range = rangeDeg(draft.joints[joint]);
    const [torque_nm, resistance_nm] = [torqueNm(torque), torqueNm(resistance)];
    if (!range || torque_nm === null || resistance_nm === null) return null;
    passiveRange[joint] = { min_rad: radians(range[0]), max_rad: radians(range[1]) };
    forceLimits[joint] = { torque_nm, resistance_nm };
  }
  return {
    name: draft.name.trim(),
    healthy_side: draft.healthySide,
    notes: draft.notes,
    passive_range: passiveRange as PassiveRange,
    force_limits: forceLimits as ForceLimits,
    assistance: draft.assistance,
    assist_level_most: draft.most,
  };
}

type Limits = Pick<Patient, "passive_range" | "force_limits">;

function asDrafts({ passive_range, force_limits }: Limits): Record<Joint, JointDraft> {
  return eachJoint((joint) => ({
    min: inDegrees(passive_range?.[joint]?.min_rad),
    max: inDegrees(passive_range?.[joint]?.max_rad),
    torque: String(force_limits?.[joint]?.torque_nm ?? ""),
    resistance: String(force_limits?.[joint]?.resistance_nm ?? ""),
  }));
}

function inDegrees(angleRad: number | undefined): string {
  return angleRad === undefined ? "" : String(Math.round(degrees(angleRad)));
}

function eachJoint<T>(make: (joint: Joint) => T): Record<Joint, T> {
  return { plane: make("plane"), elevation: make("elevation"), rotation: make("rotation"), elbow: make("elbow") };
}
