// The figures of a session as people read them: named, grouped, in everyday units.
import type { Metric } from "../../api/types";
import { isKey, t } from "../../strings";
import { degrees, figure } from "../format";

/** A group belongs together on the page; `byJoint` ones are tables with a row per joint (or game, or sensor). */
const GROUPS = [
  { id: "exercise", byJoint: false, names: /^(active_minutes|movements|targets_\w+|success_rate|repetitions)$/ },
  { id: "games", byJoint: true, names: /^(game_\w+|reaction_time|accuracy|hold_stability)$/ },
  { id: "movement", byJoint: false, names: /^(movement_time|\w+_speed|path_ratio|sparc|velocity_peaks)$/ },
  { id: "posture", byJoint: false, names: /^(trunk|shoulder)_/ },
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

/** The joint, the game, or the sensor, whose figure it is. */
export function jointOf(metric: Metric): string {
  return translatedOr(`joint.${metric.joint}`, translatedOr(`game.${metric.joint}`, metric.joint));
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

/** What must be said beside more than one of the figures. */
export function sharedCaveatsOf(metrics: readonly Metric[]): string[] {
  const said = metrics.map(caveatOf);
  return caveatsOf(metrics).filter((caveat) => said.indexOf(caveat) !== said.lastIndexOf(caveat));
}

export function translatedOr(key: string, otherwise: string): string {
  return isKey(key) ? t(key) : otherwise;
}

/** How an SI value is shown. */
interface Unit {
  times: number;
  digits: (shown: number) => number;
  sign: string;
}

const IN_PERCENT = new Set(["success_rate", "own_work_share", "help", "help_allowed", "game_success", "game_level"]);
const PERCENT: Unit = { times: 100, digits: (shown) => (Math.abs(shown) < 10 && shown % 1 !== 0 ? 1 : 0), sign: " %" };

const UNITS: Record<string, Unit> = {
  rad: { times: degrees(1), digits: () => 0, sign: "°" },
  m: { times: 100, digits: () => 1, sign: " cm" },
  "m/s": { times: 1, digits: () => 2, sign: " m/s" },
  s: { times: 1, digits: (shown) => (Math.abs(shown) < 10 ? 2 : 0), sign: " s" },
  "N m": { times: 1, digits: () => 1, sign: " Nm" },
  J: { times: 1, digits: (shown) => (Math.abs(shown) < 10 ? 1 : 0), sign: " J" },
  min: { times: 1, digits: () => 1, sign: " min" },
  Hz: { times: 1, digits: () => 1, sign: " /s" },
  "1": { times: 1, digits: (shown) => (Number.isInteger(shown) ? 0 : 2), sign: "" },
};

/** A figure in the unit people read it in. */
export function amountOf(metric: Pick<Metric, "name" | "unit" | "value">): string {
  if (metric.value === null) return t("figure.unknown");
  const unit = unitOf(metric);
  const shown = metric.value * unit.times;
  return `${figure(shown, unit.digits(shown))}${unit.sign}`;
}

export function unitOf({ name, unit }: Pick<Metric, "name" | "unit">): Unit {
  if (IN_PERCENT.has(name)) return PERCENT;
  return UNITS[unit] ?? { times: 1, digits: () => 2, sign: ` ${unit}` };
}

/** What tells one figure from another across sessions. */
export function identityOf({ name, joint, side }: Pick<Metric, "name" | "joint" | "side">): string {
  return `${name}/${joint}/${side}`;
}
