// Which games have a scene: every folder in scenes/. Each is a file of its own for the browser, fetched when its game
// is first played.
import type { OpenScene } from "./scene";

const FOLDERS = import.meta.glob<{ readonly open: OpenScene }>("./scenes/*/index.ts");

/** The scene of a game; null where this page has none by that name. */
export function sceneOf(game: string): (() => Promise<OpenScene>) | null {
  const load = FOLDERS[`./scenes/${game}/index.ts`];
  return load ? async () => (await load()).open : null;
}
