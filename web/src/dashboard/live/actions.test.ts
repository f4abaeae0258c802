import { describe, expect, test } from "vitest";
import type { Action, DriveState, LiveTick } from "../../api/types";
import { isPossible } from "./actions";

const ACTIONS: Action[] = ["start", "hold", "resume", "stop", "reset"];
const tick = (state: DriveState, mayEnable = false) => ({ state, may_enable: mayEnable }) as LiveTick;
const possible = (now: LiveTick | null) => ACTIONS.filter((action) => isPossible(action, now));

describe("the buttons", () => {
  test("stop is possible in every state, and where the state is not known", () => {
    for (const state of ["off", "ready", "engaged", "hold", "fault", "stopped"] as const) {
      expect(isPossible("stop", tick(state))).toBe(true);
    }
    expect(possible(null)).toEqual(["stop"]);
  });

  test("start needs a station that would grant it", () => {
    expect(possible(tick("ready"))).toEqual(["stop"]);
    expect(possible(tick("ready", true))).toEqual(["start", "stop"]);
  });

  test("hold, resume and reset belong to one state each", () => {
    expect(possible(tick("engaged"))).toEqual(["hold", "stop"]);
    expect(possible(tick("hold"))).toEqual(["resume", "stop"]);
    expect(possible(tick("stopped"))).toEqual(["stop", "reset"]);
    expect(possible(tick("fault"))).toEqual(["stop", "reset"]);
  });
});
