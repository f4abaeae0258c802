// What may be wished of the game as it stands; the service decides, this spares a useless press.
import type { GameView, GameWish } from "../../../api/types";
import type { Charge } from "../charge";

type Standing = Pick<GameView, "phase" | "next_game">;

/** The one of start, pause and go on that fits: they share a place, for never two of them do. */
export function mainWish({ phase }: Standing): "start" | "pause" | "go_on" | null {
  switch (phase) {
    case "waiting":
    case "between":
      return "start";
    case "playing":
      return "pause";
    case "rest":
    case "paused":
      return "go_on";
    default:
      return null;
  }
}

export function mayRest({ phase }: Standing): boolean {
  return phase === "playing";
}

export function mayGoToNext({ phase, next_game }: Standing): boolean {
  return phase !== "over" && next_game !== "";
}

/** A difficulty can be set while there is a game to set it for. */
export function maySetLevel({ phase }: Standing): boolean {
  return phase !== "over" && phase !== "between";
}

/** Everybody may pause; the rest is for the page in charge. */
export function mayWishOfGame(wish: GameWish, charge: Charge): boolean {
  return wish === "pause" || charge === "mine";
}

/** Share of attempts that succeeded; null before the first. */
export function successOf({ hits, misses }: Pick<GameView, "hits" | "misses">): number | null {
  return hits + misses > 0 ? hits / (hits + misses) : null;
}
