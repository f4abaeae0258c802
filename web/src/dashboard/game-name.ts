// What a game is called and what it is for, in the language chosen; the service's own word where there is none yet.
import { isKey, t } from "../strings";

export function gameName(game: string): string {
  return translated(`game.${game}`) || game;
}

/** The therapeutic aim in a line. */
export function gameAim(game: string): string {
  return translated(`game.${game}.aim`);
}

function translated(key: string): string {
  return isKey(key) ? t(key) : "";
}
