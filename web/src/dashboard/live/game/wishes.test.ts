import { describe, expect, test } from "vitest";
import type { GameView } from "../../../api/types";
import { mainWish, mayGoToNext, mayRest, maySetLevel, mayWishOfGame, successOf } from "./wishes";

const PHASES: GameView["phase"][] = ["waiting", "playing", "rest", "paused", "between", "over"];
const standing = (phase: GameView["phase"], next_game = "trace") => ({ phase, next_game });

describe("the game's buttons", () => {
  test("begin, pause or go on: one of them at a time, none when all is over", () => {
    expect(PHASES.map((phase) => mainWish(standing(phase)))).toEqual([
      "start",
      "pause",
      "go_on",
      "go_on",
      "start",
      null,
    ]);
  });

  test("a rest interrupts playing only", () => {
    expect(PHASES.filter((phase) => mayRest(standing(phase)))).toEqual(["playing"]);
  });

  test("the next game needs one, and a session that is not over", () => {
    expect(PHASES.filter((phase) => mayGoToNext(standing(phase)))).not.toContain("over");
    expect(PHASES.some((phase) => mayGoToNext(standing(phase, "")))).toBe(false);
  });

  test("the difficulty is set for a game, not between two", () => {
    expect(PHASES.filter((phase) => maySetLevel(standing(phase)))).toEqual(["waiting", "playing", "rest", "paused"]);
  });

  test("whoever only watches may pause, nothing else", () => {
    for (const charge of ["other", "gone"] as const) {
      expect(mayWishOfGame("pause", charge)).toBe(true);
      expect(mayWishOfGame("pin", charge)).toBe(false);
    }
  });
});

test("success is a share of attempts, unknown before the first", () => {
  expect(successOf({ hits: 0, misses: 0 })).toBeNull();
  expect(successOf({ hits: 3, misses: 1 })).toBe(0.75);
});
