// Where a replay stands between two answers of the service, and the events on its way.
import type { Replay, Timeline } from "../../api/types";

/** What the service said, and when it said so on this page's clock. */
export interface Heard {
  replay: Replay;
  at_ms: number;
}

/** The position now: the service's, gone on at its speed since. */
export function positionAt({ replay, at_ms }: Heard, now_ms: number): number {
  const gone_s = replay.playing ? ((now_ms - at_ms) / 1000) * replay.speed : 0;
  return Math.min(replay.t_s + gone_s, replay.duration_s);
}

export type EventKind = "hit" | "missed" | "pain" | "hold" | "fault" | "stopped";

/** Something to jump to. */
export interface LineEvent {
  kind: EventKind;
  t_s: number;
}

const HALTS = new Set<string>(["hold", "fault", "stopped"]);
const KINDS = new Set<string>(["hit", "missed", "pain"]);

/** Everything marked, in the order in which it happened: marks, and where the arm was halted. */
export function eventsOf({ spans, marks }: Timeline): LineEvent[] {
  const halts = spans
    .filter(({ state }) => HALTS.has(state))
    .map(({ state, from_s }) => ({ kind: state, t_s: from_s }));
  const known = marks.filter(({ kind }) => KINDS.has(kind));
  return ([...halts, ...known] as LineEvent[]).sort((a, b) => a.t_s - b.t_s);
}

/** A jump lands a moment before the event, so that it is seen to happen. */
export const LEAD_S = 1;
const NEAR_S = 0.05;

/** The next event after (or before) a position, or null. */
export function neighbour(events: readonly LineEvent[], t_s: number, way: -1 | 1): LineEvent | null {
  const landed = (event: LineEvent) => Math.max(0, event.t_s - LEAD_S);
  if (way > 0) return events.find((event) => landed(event) > t_s + NEAR_S) ?? null;
  return events.filter((event) => landed(event) < t_s - NEAR_S).at(-1) ?? null;
}
