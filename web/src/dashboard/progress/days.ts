// The days that every chart of a page shows, so that one can be read under the other.
import type { ProgressLine, Score } from "../../api/types";
import { dayOf } from "../format";
import type { Span } from "../time-chart";

const DAY_MS = 24 * 3600 * 1000;
/** Beyond the first and the last, so that no point sits on the edge. */
const MARGIN = 0.03;

export function daysOf(lines: readonly ProgressLine[], scores: readonly Score[]): Span {
  const played = lines.flatMap(({ points }) => points.map(({ at }) => Date.parse(at)));
  const moments = [...played, ...scores.map(({ on }) => middayOf(on))];
  if (moments.length === 0) return { from: Date.now() - DAY_MS, to: Date.now() };
  const [from, to] = [Math.min(...moments), Math.max(...moments)];
  const margin = Math.max((to - from) * MARGIN, DAY_MS / 2);
  return { from: from - margin, to: to + margin };
}

/** A day without a time is drawn at its noon. */
export function middayOf(on: string): number {
  return dayOf(on).getTime() + DAY_MS / 2;
}
