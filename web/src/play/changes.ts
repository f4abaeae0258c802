// What has happened between two pictures of the game. The stream skips pictures on slow screens, so this is read
// from the counters, which lose nothing, and not from a picture's own feedback list.
import type { LiveMessage } from "../api/types";

type Point = readonly [number, number, number];

/** One thing to draw; `kind` and `state` are the game's own words. */
export interface ThingView {
  readonly id: number;
  readonly kind: string;
  readonly position: Point;
  readonly radius_m: number;
  readonly progress: number;
  readonly state: string;
  readonly turn_rad: number;
}

/** A spot in space that is chosen by staying there with the hand. */
export interface ChoiceView {
  readonly id: string;
  readonly position: Point;
  readonly radius_m: number;
  readonly progress: number;
}

export interface GameView {
  readonly game: string;
  readonly phase: string;
  readonly score: number;
  readonly streak: number;
  readonly round: number;
  readonly rounds: number;
  readonly things: readonly ThingView[];
  readonly way: readonly Point[];
  readonly hand: Point;
  readonly aim: Point | null;
  readonly time_left_s: number;
  readonly hits: number;
  readonly misses: number;
  readonly level: number;
  readonly pinned: boolean;
  readonly feedback: readonly string[];
  readonly choices: readonly ChoiceView[];
  readonly posture: string;
  readonly rest_suggested: boolean;
  readonly exercise: number;
  readonly exercises: number;
  readonly next_game: string;
  readonly total_score: number;
}

/** The game's picture in a message, also as a service sends it that does not know the newer fields yet. */
export function viewOf(message: LiveMessage): GameView | null {
  const game = message.game as (Partial<GameView> & { targets?: readonly Partial<ThingView>[] }) | null;
  if (!game || game.things) return game as GameView | null;
  const things = (game.targets ?? []).map((one) => ({ kind: "", state: "", turn_rad: 0, ...one }) as ThingView);
  const aim = things[0]?.position ?? null;
  const plain = { way: [], choices: [], posture: "", exercise: 1, exercises: 1, next_game: "", total_score: 0 };
  return { ...plain, pinned: false, rest_suggested: false, ...game, things, aim } as unknown as GameView;
}

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
