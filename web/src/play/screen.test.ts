import { describe, expect, it } from "vitest";
import { STALE_S } from "../api/live";
import type { LiveMessage } from "../api/types";
import { affectedSide, clockText, faceFor } from "./screen";

function message(state: string, phase: string | null, session = "s1", compliant = false): LiveMessage {
  const game = phase === null ? null : { phase };
  const open = session === "" ? null : { id: 1 };
  return { tick: { state, session, exo: { compliant } }, game, session: open } as unknown as LiveMessage;
}

describe("faceFor", () => {
  it.each([
    ["engaged", "playing", "playing"],
    ["engaged", "rest", "rest"],
    ["engaged", "waiting", "waiting"],
    ["engaged", "paused", "break"],
    ["engaged", "between", "between"],
    ["engaged", null, "waiting"],
    ["hold", "between", "paused"],
    ["hold", "playing", "paused"],
    ["hold", "rest", "paused"],
    ["stopped", "playing", "stopped"],
    ["fault", "playing", "fault"],
    ["ready", "waiting", "ready"],
    ["off", null, "ready"],
    ["stopped", "over", "over"],
  ])("shows a %s station in phase %s as %s", (state, phase, face) => {
    expect(faceFor("open", message(state, phase), 0, null)).toBe(face);
  });

  it("tells a hold that gives way from a pause", () => {
    expect(faceFor("open", message("hold", "playing", "s1", true), 0, null)).toBe("eased");
  });

  it("welcomes until a session is open", () => {
    expect(faceFor("open", null, 0, null)).toBe("welcome");
    expect(faceFor("open", message("off", null, ""), 0, null)).toBe("welcome");
  });

  it("takes leave after a session in which something was played", () => {
    expect(faceFor("open", message("off", null, ""), 0, { session: 1, points: 40, until_s: null })).toBe("ended");
  });

  it("never shows an old picture as if it were true", () => {
    expect(faceFor("open", message("engaged", "playing"), STALE_S + 0.1, null)).toBe("lost");
    expect(faceFor("lost", message("engaged", "playing"), 0, null)).toBe("lost");
  });

  it("asks for a log-in where there is none", () => {
    expect(faceFor("locked", null, 0, null)).toBe("locked");
  });
});

describe("clockText", () => {
  it.each([
    [65, "1:05"],
    [59.2, "1:00"],
    [0.4, "0:01"],
    [0, "0:00"],
    [-3, "0:00"],
  ])("shows %d s as %s", (seconds, text) => {
    expect(clockText(seconds)).toBe(text);
  });
});

describe("affectedSide", () => {
  it("is the other one", () => {
    expect([affectedSide("left"), affectedSide("right")]).toEqual(["right", "left"]);
  });
});
