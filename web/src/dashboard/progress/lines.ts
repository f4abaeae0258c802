// A patient's figures over the sessions, put together for a person: which belong together, and what can be said.
import type { ProgressLine, Side } from "../../api/types";
import { t } from "../../strings";
import { amountOf, translatedOr, unitOf } from "../session/metrics";

/** One measure of one joint (or game), for whichever arms there are figures of. */
export interface Family {
  id: string;
  name: string;
  joint: string;
  lines: readonly ProgressLine[];
}

/** Measures in the service's order, each with both arms together. */
export function familiesOf(lines: readonly ProgressLine[]): Family[] {
  const families = new Map<string, ProgressLine[]>();
  for (const line of lines) {
    const id = `${line.name}/${line.joint}`;
    families.set(id, [...(families.get(id) ?? []), line]);
  }
  return [...families].map(([id, members]) => {
    const [name = "", joint = ""] = id.split("/");
    return { id, name, joint, lines: members };
  });
}

/** What a therapist looks at first, in order; games' figures come with their games' names. */
const FIRST: readonly RegExp[] = [
  /^own_range\/(elevation|elbow)$/,
  /^range_of_movement\/(elevation|elbow)$/,
  /^own_work_share\//,
  /^repetitions\//,
  /^game_level\//,
  /^accuracy\//,
  /^movement_time\//,
  /^sparc\//,
  /^trunk_displacement\//,
  /^pain_after\//,
];
const MOST_FIRST = 8;
/** Of one measure, so that six games leave room for the rest. */
const MOST_EACH = 2;

export function firstFamilies(families: readonly Family[]): Family[] {
  const ordered = FIRST.flatMap((pattern) => families.filter(({ id }) => pattern.test(id)).slice(0, MOST_EACH));
  return ordered.slice(0, MOST_FIRST);
}

/** The arm that a verdict is about: the affected one, unless the drive moved it. */
export function mainLine({ lines }: Family, affected: Side): ProgressLine | null {
  const own = lines.find((line) => line.side === affected && !isDriven(line));
  return own ?? lines.find((line) => !isDriven(line)) ?? lines[0] ?? null;
}

const DRIVEN = "caveat.passive_drive";

/** Whether the drive moved the arm in the first or the last session: then nothing is said of the patient. */
export function isDriven({ points }: Pick<ProgressLine, "points">): boolean {
  return points[0]?.caveat === DRIVEN || points.at(-1)?.caveat === DRIVEN;
}

export function familyName({ lines, joint }: Family): string {
  const [line] = lines;
  if (!line) return "";
  const name = translatedOr(line.label, line.name.replaceAll("_", " "));
  return joint ? `${name}, ${placeName(joint)}` : name;
}

/** A joint's name, or a game's. */
function placeName(joint: string): string {
  return translatedOr(`joint.${joint}`, translatedOr(`game.${joint}`, joint));
}

/** A value of the line in everyday units. */
export function amount(line: ProgressLine, value: number | null): string {
  return value === null ? "–" : amountOf({ ...line, value });
}

/** With its sign, for a difference. */
export function signedAmount(line: ProgressLine, value: number | null): string {
  const text = amount(line, value);
  return value !== null && value > 0 ? `+${text}` : text;
}

/** Factor from SI to what is shown, and the sign behind it. */
export function shownIn(line: ProgressLine): { times: number; sign: string } {
  return unitOf(line);
}

/** What the service says, or why it can say nothing. */
export type Said = ProgressLine["verdict"] | "one" | "driven" | "poor";

export function saidOf(line: ProgressLine): Said {
  if (line.verdict !== "unknown") return line.verdict;
  if (line.points.length < 2) return "one";
  if (isDriven(line)) return "driven";
  return line.trust === "poor" ? "poor" : "unknown";
}

/** A sign for each verdict, so that a glance and no colour is needed. */
export function verdictSign({ verdict }: ProgressLine): string {
  return { better: "▲", worse: "▼", changed: "◆", unchanged: "＝", unknown: "–" }[verdict];
}

export function verdictWords(line: ProgressLine): string {
  const difference = line.difference === null ? "–" : signedAmount(line, line.difference);
  return t(`progress.verdict.${saidOf(line)}`, { difference, mdc: amount(line, line.mdc) });
}

/** What can be said of a scored test, more of which is better on all of them; null = how much it varies is not known. */
export function saidOfScores(values: readonly number[], mdc: number | null): Said {
  const [first, last] = [values[0], values.at(-1)];
  if (first === undefined || last === undefined || values.length < 2) return "one";
  if (mdc === null) return "unknown";
  if (Math.abs(last - first) <= mdc) return "unchanged";
  return last > first ? "better" : "worse";
}
