import { describe, expect, it } from "vitest";
import type { GameView } from "./changes";
import { wordsFor } from "./words";

const game = { game: "reach", next_game: "catch", time_left_s: 12.2, total_score: 340 } as unknown as GameView;
const visit = { session: 1, points: 70, until_s: null };

describe("wordsFor", () => {
  it("names the game that begins and the one that comes next, with when", () => {
    expect(wordsFor("waiting", { game, visit: null })).toMatchObject({
      title: "Picking fruit",
      countdown: "Begins in 0:13",
    });
    expect(wordsFor("between", { game, visit: null }).title).toMatch(/^Next: /);
  });

  it("shows what was won at the end, also of a session that was closed half-way", () => {
    expect(wordsFor("over", { game, visit: null }).points).toBe(340);
    expect(wordsFor("ended", { game: null, visit }).points).toBe(70);
  });

  it("promises that the game waits only where one was being played", () => {
    expect(wordsFor("lost", { game: null, visit: null }).text).not.toMatch(/game/);
    expect(wordsFor("lost", { game, visit }).text).toMatch(/the game waits/);
  });
});
