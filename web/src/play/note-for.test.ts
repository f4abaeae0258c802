import { describe, expect, it } from "vitest";
import type { LiveMessage } from "../api/types";
import { Notes } from "./note-for";

interface Given {
  readonly mode?: string;
  readonly screens?: number;
  readonly game?: Partial<NonNullable<LiveMessage["game"]>>;
}

const message = ({ mode = "passive", screens = 1, game = {} }: Given): LiveMessage =>
  ({
    tick: { exo: { assistance: mode } },
    session: { id: 1, patient_screens: screens },
    game: { game: "reach", exercise: 1, posture: "", rest_suggested: false, ...game },
  }) as unknown as LiveMessage;

/** Takes these a second apart. */
function told(...given: readonly Given[]): Notes {
  const notes = new Notes();
  for (const [i, one] of given.entries()) notes.take(message(one), i);
  return notes;
}

describe("Notes", () => {
  it("tells a change of help for a while, and not what a session begins with", () => {
    expect(told({ mode: "free" }).at(0.1, "playing")).toBeNull();
    const notes = told({}, { mode: "free" });
    expect(notes.at(2, "playing")).toEqual({ kind: "help", mode: "free" });
    expect(notes.at(20, "playing")).toBeNull();
  });

  it("tells one thing at a time, the change of help before the posture", () => {
    expect(told({}, { mode: "free", game: { posture: "lean" } }).at(1.1, "playing")?.kind).toBe("help");
    expect(told({}, { game: { posture: "hitch" } }).at(1.1, "playing")?.kind).toBe("hitch");
  });

  it("leaves a posture that is right again alone after a moment", () => {
    const notes = told({ game: { posture: "lean" } }, {});
    expect([notes.at(1, "playing")?.kind, notes.at(4, "playing")]).toEqual(["lean", null]);
  });

  it("names a game that has just begun, and suggests a rest once", () => {
    expect(told({}, { game: { game: "row", exercise: 2 } }).at(1, "playing")).toEqual({ kind: "game", game: "row" });
    expect(told({}, { game: { rest_suggested: true } }).at(1, "playing")?.kind).toBe("tired");
  });

  it("says on any face that a second screen has been opened, and nothing else beside words", () => {
    expect(told({ screens: 2 }).at(1, "welcome")?.kind).toBe("screens");
    expect(told({}, { mode: "free" }).at(1, "rest")).toBeNull();
    expect(told({ screens: 0 }, { screens: 1 }).at(1, "waiting")).toBeNull();
  });
});
