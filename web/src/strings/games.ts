// What a game is called, what it is for and how it is played, in the language chosen (game-<name>.ts).
import { isKey, t } from "./index";

/** The game's name; the service's own word where there is none yet. */
export function gameName(game: string): string {
  return translated(`game.${game}`) || game;
}

/** The therapeutic aim in a line; "" where there is none. */
export function gameAim(game: string): string {
  return translated(`game.${game}.aim`);
}

/** One short sentence for the patient; "" where there is none. */
export function howToPlay(game: string): string {
  return translated(`game.${game}.how`);
}

function translated(key: string): string {
  return isKey(key) ? t(key) : "";
}
