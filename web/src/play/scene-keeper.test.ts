import { Group, Scene } from "three";
import { describe, expect, it, vi } from "vitest";
import { changesBetween, type GameView } from "./changes";
import type { GameScene, OpenScene } from "./scene";
import { SceneKeeper } from "./scene-keeper";

/** A scene that notes what becomes of it. */
class Noted implements GameScene {
  readonly group = new Group();
  readonly scenery = new Scene();
  shown = 0;
  closed = false;

  show(): [] {
    this.shown += 1;
    return [];
  }
  animate(): void {}
  close(): void {
    this.closed = true;
  }
}

const view = (game: string) => ({ game, things: [], phase: "playing", exercise: 1 }) as unknown as GameView;
const opened: Noted[] = [];
const open: OpenScene = () => {
  const scene = new Noted();
  opened.push(scene);
  return scene;
};

function keeper(find: (game: string) => Promise<OpenScene>) {
  opened.length = 0;
  const entered: GameScene[] = [];
  const keeper = new SceneKeeper(
    (game) => (game === "unknown" ? null : () => find(game)),
    (scene) => entered.push(scene),
  );
  return { keeper, entered };
}

describe("SceneKeeper", () => {
  it("keeps the picture before until the next one has been fetched", async () => {
    let deliver: (open: OpenScene) => void = () => {};
    const slow = new Promise<OpenScene>((resolve) => {
      deliver = resolve;
    });
    const { keeper: it, entered } = keeper((game) => (game === "catch" ? slow : Promise.resolve(open)));
    it.want("reach", "right");
    await vi.waitFor(() => expect(entered).toHaveLength(1));
    it.want("catch", "right");
    expect([opened[0]?.closed, it.shown]).toEqual([false, "reach"]);
    deliver(open);
    await vi.waitFor(() => expect(entered).toHaveLength(2));
    expect([opened[0]?.closed, it.current, it.shown]).toEqual([true, opened[1], "catch"]);
  });

  it("gives a scene no other game's picture", async () => {
    const { keeper: it } = keeper(() => Promise.resolve(open));
    it.want("reach", "right");
    await vi.waitFor(() => expect(opened).toHaveLength(1));
    it.show(view("catch"), changesBetween(null, view("catch")));
    expect(opened[0]?.shown).toBe(0);
    it.show(view("reach"), changesBetween(null, view("reach")));
    expect(opened[0]?.shown).toBe(1);
  });

  it("opens anew for another side and for a game that begins again, and only then", async () => {
    const { keeper: it } = keeper(() => Promise.resolve(open));
    it.want("reach", "right");
    await vi.waitFor(() => expect(opened).toHaveLength(1));
    it.want("reach", "right");
    expect(opened).toHaveLength(1);
    it.want("reach", "left");
    it.begin("reach", "left");
    expect(opened.map((scene) => scene.closed)).toEqual([true, true, false]);
  });

  it("tries again where the connection broke while a scene was fetched", async () => {
    vi.useFakeTimers();
    let attempts = 0;
    const { keeper: it, entered } = keeper(() =>
      ++attempts > 1 ? Promise.resolve(open) : Promise.reject(new Error()),
    );
    it.want("reach", "right");
    await vi.advanceTimersByTimeAsync(5000);
    vi.useRealTimers();
    expect([attempts, entered.length]).toEqual([2, 1]);
  });

  it("says that this page has no scene for a game", () => {
    const { keeper: it } = keeper(() => Promise.resolve(open));
    it.want("unknown", "right");
    expect([it.isUnknown, it.current]).toEqual([true, null]);
  });
});
