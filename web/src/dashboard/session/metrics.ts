// The figures of a session as people read them: named, grouped, in everyday units.
import type { Metric, SessionDetail } from "../../api/types";
import { isKey, t } from "../../strings";
import { degrees, figure } from "../format";

/** A group belongs together on the page; `byJoint` ones are tables with a row per joint (or sensor). */
const GROUPS = [
  { id: "exercise", byJoint: false, names: /^(active_minutes|movements|targets_\w+|success_rate)$/ },
  { id: "movement", byJoint: false, names: /^(movement_time|peak_speed|mean_speed|path_ratio|sparc|trunk_\w+)$/ },
  { id: "range", byJoint: true, names: /^range_/ },
  { id: "help", byJoint: false, names: /^(minutes_\w+|help\w*|\w+_work|own_work_share|soft_holds|pain_calls)$/ },
  { id: "own", byJoint: true, names: /^own_/ },
  { id: "mirror", byJoint: true, names: /^(symmetry|lag)$/ },
  { id: "time", byJoint: false, names: /^time_/ },
  { id: "sensors", byJoint: true, names: /^sensor_/ },
  { id: "other", byJoint: false, names: /./ },
] as const;

export interface Group {
  id: (typeof GROUPS)[number]["id"];
  byJoint: boolean;
  metrics: Metric[];
}

/** The groups that have figures, in the order in which a therapist asks; each figure in the first that fits. */
export function grouped(metrics: readonly Metric[]): Group[] {
  const groupOf = (metric: Metric) => GROUPS.find(({ names }) => names.test(metric.name))?.id;
  return GROUPS.map(({ id, byJoint }) => ({
    id,
    byJoint,
    metrics: metrics.filter((metric) => groupOf(metric) === id),
  })).filter((group) => group.metrics.length > 0);
}

/** The figure's name in the language chosen; the service's own where there is none yet. */
export function nameOf(metric: Metric): string {
  return translatedOr(metric.label, metric.name.replaceAll("_", " "));
}

/** The name with the joint it is of, for where no table says so. */
export function fullNameOf(metric: Metric): string {
  return metric.joint ? `${nameOf(metric)}, ${jointOf(metric)}` : nameOf(metric);
}

/** The joint, or the sensor, whose figure it is. */
export function jointOf(metric: Metric): string {
  return translatedOr(`joint.${metric.joint}`, metric.joint);
}

export function explanationOf(metric: Metric): string {
  return translatedOr(`${metric.label}.means`, "");
}

export function caveatOf(metric: Metric): string {
  return translatedOr(metric.caveat, metric.caveat);
}

/** What must be said beside a group of figures, each once. */
export function caveatsOf(metrics: readonly Metric[]): string[] {
  return [...new Set(metrics.map(caveatOf).filter(Boolean))];
}

export function translatedOr(key: string, otherwise: string): string {
  return isKey(key) ? t(key) : otherwise;
}

type Unit = readonly [(value: number) => string, string];

const IN_PERCENT = new Set(["success_rate", "own_work_share", "help", "help_allowed"]);
const PERCENT: Unit = [(value) => figure(value * 100), " %"];

const UNITS: Record<string, Unit> = {
  rad: [(value) => figure(degrees(value)), "°"],
  m: [(value) => figure(value * 100, 1), " cm"],
  "m/s": [(value) => figure(value, 2), " m/s"],
  s: [(value) => figure(value, value < 10 ? 2 : 0), " s"],
  "N m": [(value) => figure(value, 1), " Nm"],
  J: [(value) => figure(value, value < 10 ? 1 : 0), " J"],
  min: [(value) => figure(value, 1), " min"],
  Hz: [(value) => figure(value, 1), " /s"],
  "1": [(value) => figure(value, Number.isInteger(value) ? 0 : 2), ""],
};

/** A figure in the unit people read it in. */
export function amountOf(metric: Metric): string {
  if (metric.value === null) return t("figure.unknown");
  const [said, unit] = unitOf(metric);
  return `${said(metric.value)}${unit}`;
}

function unitOf(metric: Metric): Unit {
  if (IN_PERCENT.has(metric.name)) return PERCENT;
  return UNITS[metric.unit] ?? [(value) => figure(value, 2), ` ${metric.unit}`];
}

/** What tells one figure from another across sessions. */
export function identityOf({ name, joint, side }: Pick<Metric, "name" | "joint" | "side">): string {
  return `${name}/${joint}/${side}`;
}

/** One figure over several sessions, oldest first; sessions without it are left out. */
export function seriesOf(sessions: readonly SessionDetail[], identity: string): Metric[] {
  return [...sessions]
    .sort((a, b) => Date.parse(a.started_at ?? "") - Date.parse(b.started_at ?? ""))
    .flatMap((session) => session.metrics.filter((one) => identityOf(one) === identity && one.value !== null));
}
