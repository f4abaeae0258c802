// What the panel says on each face: a title, a sentence, what helps, and when it goes on by itself.
import { type Key, t } from "../strings";
import { gameName, howToPlay } from "../strings/games";
import type { GameView } from "./changes";
import { clockText, type Face } from "./screen";
import type { Visit } from "./visit";

export interface Words {
  readonly title: string;
  readonly text: string;
  /** Points to be shown large, where there is something to be proud of. */
  readonly points: number | null;
  /** When it goes on; "" where it does not go on by itself. */
  readonly countdown: string;
}

/** What is known beside the face. */
export interface Known {
  readonly game: GameView | null;
  readonly visit: Visit | null;
}

export function wordsFor(face: Face, { game, visit }: Known): Words {
  const plain = { points: null, countdown: "" };
  switch (face) {
    case "playing":
      return { ...plain, title: "", text: "" };
    case "waiting":
      return game ? begins(gameName(game.game), game.game, game) : { ...plain, ...said(face) };
    case "between":
      return game
        ? begins(t("play.next", { game: gameName(game.next_game) }), game.next_game, game)
        : { ...plain, ...said(face) };
    case "rest":
      return { ...said(face), points: null, countdown: inTime(game, "play.rest.left") };
    case "over":
      return { ...said(face), points: game?.total_score ?? null, countdown: "" };
    case "ended":
      return { ...said(face), points: visit?.points ?? null, countdown: "" };
    case "lost":
      return { ...plain, title: t("play.lost.title"), text: t(visit ? "play.lost.game" : "play.lost.text") };
    default:
      return { ...plain, ...said(face) };
  }
}

/** How a game is played, and when it begins. */
function begins(title: string, name: string, game: GameView): Words {
  return { title, text: howToPlay(name), points: null, countdown: inTime(game, "play.begins") };
}

function inTime(game: GameView | null, key: Key): string {
  return game ? t(key, { time: clockText(game.time_left_s) }) : "";
}

function said(face: Exclude<Face, "playing">): Pick<Words, "title" | "text"> {
  return { title: t(`play.${face}.title`), text: t(`play.${face}.text`) };
}
