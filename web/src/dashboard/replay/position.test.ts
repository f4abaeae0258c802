import { describe, expect, test } from "vitest";
import type { Replay, Timeline } from "../../api/types";
import { eventsOf, neighbour, positionAt } from "./position";

const REPLAY: Replay = { session_id: 7, duration_s: 60, t_s: 10, playing: true, speed: 2 };
const LINE: Timeline = {
  session_id: 7,
  duration_s: 60,
  spans: [
    { state: "engaged", from_s: 0, to_s: 20 },
    { state: "hold", from_s: 20, to_s: 25 },
    { state: "engaged", from_s: 25, to_s: 60 },
  ],
  marks: [
    { kind: "hit", t_s: 5 },
    { kind: "pain", t_s: 20 },
    { kind: "missed", t_s: 40 },
  ],
};

describe("the position", () => {
  test("goes on at the speed while it plays, and stays at the end", () => {
    expect(positionAt({ replay: REPLAY, at_ms: 1000 }, 6000)).toBe(20);
    expect(positionAt({ replay: REPLAY, at_ms: 1000 }, 600_000)).toBe(60);
  });

  test("stands while it is paused", () => {
    expect(positionAt({ replay: { ...REPLAY, playing: false }, at_ms: 0 }, 600_000)).toBe(10);
  });
});

describe("events", () => {
  const events = eventsOf(LINE);

  test("are what was marked and where the arm was halted, in order", () => {
    expect(events.map(({ kind, t_s }) => `${kind} ${t_s}`)).toEqual(["hit 5", "hold 20", "pain 20", "missed 40"]);
  });

  test("follow one another by the button, each a moment before it happens", () => {
    expect(neighbour(events, 0, 1)?.kind).toBe("hit");
    expect(neighbour(events, 4, 1)?.kind).toBe("hold");
    expect(neighbour(events, 19, 1)?.kind).toBe("missed");
    expect(neighbour(events, 39, 1)).toBeNull();
    expect(neighbour(events, 39, -1)?.kind).toBe("pain");
    expect(neighbour(events, 4, -1)).toBeNull();
  });
});
