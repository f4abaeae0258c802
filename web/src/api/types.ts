// Short names for the generated types of the service (schema.d.ts; `make types` renews it).
import type { components } from "./schema";

type Schemas = components["schemas"];

export type Account = Schemas["AccountPublic"];
export type Action = Schemas["Control"]["action"];
export type Adherence = Schemas["Adherence"];
export type Assistance = Schemas["Assistance"];
export type Authority = Schemas["AuthorityView"];
export type ArmView = Schemas["ArmView"];
export type Curves = Schemas["Curves"];
export type DriveState = Schemas["DriveState"];
export type ErrorDetail = Schemas["ErrorDetail"];
export type Exercise = Schemas["Exercise"];
export type ForceLimits = Schemas["ForceLimits"];
export type GameWish = Schemas["GameWish"]["wish"];
export type GameView = Schemas["GameView"];
export type JointLimits = Schemas["JointLimits"];
export type JointRange = Schemas["JointRange"];
export type LiveMessage = Schemas["LiveMessage"];
export type LiveTick = Schemas["LiveTick"];
export type Metric = Schemas["MetricPublic"];
export type PassiveRange = Schemas["PassiveRange"];
export type Patient = Schemas["PatientPublic"];
export type PatientLimits = Schemas["PatientLimits"];
export type PatientForm = Schemas["PatientCreate"];
export type PatientToday = Schemas["PatientToday"];
export type PersonView = Schemas["PersonView"];
export type Plan = Schemas["PlanPublic"];
export type PlanForm = Schemas["PlanForm"];
export type Progress = Schemas["Progress"];
export type ProgressLine = Schemas["ProgressLine"];
export type Replay = Schemas["ReplayPublic"];
export type ReplayForm = Schemas["ReplayForm"];
export type Measure = Schemas["MeasurePublic"];
export type Scale = Schemas["ScalePublic"];
export type Score = Schemas["ClinicalScorePublic"];
export type ScoreForm = Schemas["ClinicalScoreForm"];
export type SensorView = Schemas["SensorView"];
export type Session = Schemas["SessionPublic"];
export type SessionDetail = Schemas["SessionDetail"];
export type SessionEvent = Schemas["EventPublic"];
export type SessionOpen = Schemas["SessionOpen"];
export type SessionUpdate = Schemas["SessionUpdate"];
export type Screen = Schemas["Screen"];
export type Side = Schemas["Side"];
export type SessionWorkspace = Schemas["SessionWorkspacePublic"];
export type Station = Schemas["Station"];
export type Status = Schemas["Status"];
export type Timeline = Schemas["Timeline"];
export type View3dLook = Schemas["View3DLook"];
export type View3dShown = Schemas["View3DShown"];

/** The exoskeleton's joints, in the order in which the service lists their values. */
export const JOINTS = ["plane", "elevation", "rotation", "elbow"] as const;
export type Joint = (typeof JOINTS)[number];

/** How the exoskeleton can help, from most to least. */
export const ASSISTANCE = ["passive", "assisted", "free"] as const;

export function otherSide(side: Side): Side {
  return side === "left" ? "right" : "left";
}
