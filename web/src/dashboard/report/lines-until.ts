// Figures as they stood after a session: what came later is not in its report.
import type { ProgressLine } from "../../api/types";

/** The lines up to and with the session that began at `started`; those that have nothing yet are left out. */
export function linesUntil(lines: readonly ProgressLine[], started: string): ProgressLine[] {
  const last = Date.parse(started);
  return lines
    .map((line) => ({ ...line, points: line.points.filter(({ at }) => Date.parse(at) <= last) }))
    .filter(({ points }) => points.length > 0);
}

/** Those that were measured in the session itself. */
export function measuredIn(lines: readonly ProgressLine[], session: number): ProgressLine[] {
  return lines.filter(({ points }) => points.at(-1)?.session_id === session);
}

/** What a page has room for. */
export const LONGEST_NOTE = 600;

export function shortened(text: string, longest = LONGEST_NOTE): string {
  return text.length <= longest ? text : `${text.slice(0, longest).trimEnd()} …`;
}
