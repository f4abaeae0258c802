// What has happened between two pictures of the game. The stream skips pictures on slow screens, so this is read
// from the counters, which lose nothing, and not from a picture's own feedback list.
import type { LiveMessage } from "../api/types";

export type GameView = NonNullable<LiveMessage["game"]>;
export type TargetView = GameView["targets"][number];

export interface Changes {
  /** Hits and misses since the picture before. */
  readonly hits: number;
  readonly misses: number;
  readonly points: number;
  /** The series of hits has just reached a multiple of `STREAK_STEP`. */
  readonly streak: boolean;
  /** The phase, if it is another one now. */
  readonly entered: string | null;
  /** Targets that were there and are not any more. */
  readonly gone: readonly TargetView[];
}

export const STREAK_STEP = 5;

export const NOTHING: Changes = { hits: 0, misses: 0, points: 0, streak: false, entered: null, gone: [] };

/** What is new in `after`; a first picture or another game's brings no news but its phase. */
export function changesBetween(before: GameView | null, after: GameView | null): Changes {
  if (!after) return NOTHING;
  if (!before || isAnotherGame(before, after)) return { ...NOTHING, entered: after.phase };
  const still = new Set(after.targets.map((target) => target.id));
  const steps = (streak: number) => Math.floor(streak / STREAK_STEP);
  return {
    hits: after.hits - before.hits,
    misses: after.misses - before.misses,
    points: Math.max(0, after.score - before.score),
    streak: steps(after.streak) > steps(before.streak),
    entered: after.phase === before.phase ? null : after.phase,
    gone: before.targets.filter((target) => !still.has(target.id)),
  };
}

function isAnotherGame(before: GameView, after: GameView): boolean {
  return after.game !== before.game || after.hits < before.hits || after.misses < before.misses;
}
