// From where to where each arm moved: in the first session, the last and the widest one.
import type { Joint, ProgressLine, Side } from "../../api/types";

export interface Range {
  session: number;
  lowest: number;
  highest: number;
}

/** All in radians. */
export interface Ranges {
  first: Range;
  last: Range;
  best: Range;
  /** Whether the drive moved the arm: then it is the drive's range. */
  isDriven: boolean;
  /** Whether it was reached while the exoskeleton only carried the arm. */
  isOwn: boolean;
}

const DRIVEN = "caveat.passive_drive";

/** What the arm reached itself where that is known, else what it was moved through; null where nothing is. */
export function rangesOf(lines: readonly ProgressLine[], joint: Joint, side: Side): Ranges | null {
  return read(lines, "own_range", joint, side) ?? read(lines, "range", joint, side);
}

function read(lines: readonly ProgressLine[], family: "own_range" | "range", joint: Joint, side: Side): Ranges | null {
  const of = (end: "lowest" | "highest") =>
    lines.find((line) => line.name === `${family}_${end}` && line.joint === joint && line.side === side)?.points ?? [];
  const highest = new Map(of("highest").map((point) => [point.session_id, point.value]));
  const ranges = of("lowest").flatMap(({ session_id, value }) => {
    const high = highest.get(session_id);
    return high === undefined ? [] : [{ session: session_id, lowest: value, highest: high }];
  });
  const [first] = ranges;
  const last = ranges.at(-1);
  if (!first || !last) return null;
  return {
    first,
    last,
    best: ranges.reduce((best, one) => (widthOf(one) > widthOf(best) ? one : best)),
    isDriven: of("lowest").some(({ caveat }) => caveat === DRIVEN),
    isOwn: family === "own_range",
  };
}

export function widthOf({ lowest, highest }: Pick<Range, "lowest" | "highest">): number {
  return highest - lowest;
}
