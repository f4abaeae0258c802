import { describe, expect, it } from "vitest";
import { changesBetween, type GameView } from "./changes";

const view = (given: Partial<GameView>): GameView => ({
  game: "reach",
  phase: "playing",
  score: 0,
  streak: 0,
  round: 1,
  rounds: 3,
  things: [],
  way: [],
  hand: [0, 0, 0],
  aim: null,
  time_left_s: 60,
  hits: 0,
  misses: 0,
  level: 0.5,
  pinned: false,
  feedback: [],
  choices: [],
  posture: "",
  rest_suggested: false,
  exercise: 1,
  exercises: 1,
  next_game: "",
  total_score: 0,
  ...given,
});
const thing = (id: number) => ({
  id,
  kind: "fruit",
  position: [0, 0, -0.4] as [number, number, number],
  radius_m: 0.07,
  progress: 1,
  state: "",
  turn_rad: 0,
});

describe("changesBetween", () => {
  it("finds a hit though the picture with its feedback was skipped", () => {
    const before = view({ hits: 2, score: 20, things: [thing(3)] });
    const changes = changesBetween(before, view({ hits: 3, score: 32, things: [thing(4)] }));
    expect(changes).toMatchObject({ hits: 1, points: 12, misses: 0, gone: [thing(3)] });
  });

  it("says the streak once, at each fifth hit", () => {
    expect(changesBetween(view({ streak: 4 }), view({ streak: 5 })).streak).toBe(true);
    expect(changesBetween(view({ streak: 5 }), view({ streak: 6 })).streak).toBe(false);
  });

  it("says a phase only when it is entered", () => {
    expect(changesBetween(view({}), view({ phase: "rest" })).entered).toBe("rest");
    expect(changesBetween(view({}), view({})).entered).toBeNull();
  });

  it("celebrates nothing when the page is opened in the middle of a game, or another game begins", () => {
    expect(changesBetween(null, view({ hits: 9, score: 90 }))).toMatchObject({ hits: 0, points: 0 });
    expect(changesBetween(view({ hits: 9, score: 90 }), view({ hits: 1, score: 10 }))).toMatchObject({
      hits: 0,
      points: 0,
    });
  });
});
