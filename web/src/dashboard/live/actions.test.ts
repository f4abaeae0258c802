import { describe, expect, test } from "vitest";
import type { Action, DriveState, LiveTick } from "../../api/types";
import { isPossible, mayWish } from "./actions";
import type { Charge } from "./charge";

const ACTIONS: Action[] = ["start", "hold", "resume", "stop", "reset"];
const STATES: DriveState[] = ["off", "ready", "engaged", "hold", "fault", "stopped"];
const tick = (state: DriveState, mayEnable = false) => ({ state, may_enable: mayEnable }) as LiveTick;
const possible = (now: LiveTick | null, charge: Charge = "mine") =>
  ACTIONS.filter((action) => isPossible(action, now) && mayWish(action, charge));

describe("the buttons", () => {
  test("stop is possible in every state, for everybody, and where the state is not known", () => {
    for (const state of STATES) expect(possible(tick(state), "other")).toContain("stop");
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

  test("reset never starts: no state allows both", () => {
    for (const state of STATES) {
      const [reset, start] = (["reset", "start"] as const).map((one) => isPossible(one, tick(state, true)));
      expect(reset && start).toBe(false);
    }
  });

  test("who is not in charge can hold and stop, nothing else", () => {
    for (const charge of ["other", "gone"] as const) {
      const all = new Set(STATES.flatMap((state) => possible(tick(state, true), charge)));
      expect([...all].sort()).toEqual(["hold", "stop"]);
    }
  });
});
