// What has happened between two pictures of the game. The stream skips pictures on slow screens, so this is read
// from the counters, which lose nothing, and not from a picture's own feedback list.
import type { GameView as Sent } from "../api/types";

export type GameView = Sent;
/** One thing to draw; `kind` and `state` are the game's own words. */
export type ThingView = GameView["things"][number];
/** A spot in space that is chosen by staying there with the hand. */
export type ChoiceView = GameView["choices"][number];

export interface Changes {
  /** Another game than the picture before, or the first picture there is. */
  readonly fresh: boolean;
  /** Hits and misses since the picture before. */
  readonly hits: number;
  readonly misses: number;
  readonly points: number;
  /** The series of hits has just reached a multiple of `STREAK_STEP`. */
  readonly streak: boolean;
  /** The phase, if it is another one now. */
  readonly entered: string | null;
  /** Things that were there and are not any more, as they were last seen. */
  readonly gone: readonly ThingView[];
}

export const STREAK_STEP = 5;

export const NOTHING: Changes = {
  fresh: false,
  hits: 0,
  misses: 0,
  points: 0,
  streak: false,
  entered: null,
  gone: [],
};

/** What is new in `after`; a first picture or another game's brings no news but its phase. */
export function changesBetween(before: GameView | null, after: GameView | null): Changes {
  if (!after) return NOTHING;
  if (!before || isAnotherGame(before, after)) return { ...NOTHING, fresh: true, entered: after.phase };
  const still = new Set(after.things.map((thing) => thing.id));
  const steps = (streak: number) => Math.floor(streak / STREAK_STEP);
  return {
    fresh: false,
    hits: after.hits - before.hits,
    misses: after.misses - before.misses,
    points: Math.max(0, after.score - before.score),
    streak: steps(after.streak) > steps(before.streak),
    entered: after.phase === before.phase ? null : after.phase,
    gone: before.things.filter((thing) => !still.has(thing.id)),
  };
}

function isAnotherGame(before: GameView, after: GameView): boolean {
  return (
    after.game !== before.game ||
    after.exercise !== before.exercise ||
    after.hits < before.hits ||
    after.misses < before.misses
  );
}
