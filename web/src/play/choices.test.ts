import { describe, expect, it } from "vitest";
import { besideOf, wordOf } from "./choices";

describe("the choices' words", () => {
  it("stand outside where there are several", () => {
    expect([0, 1, 2].map((i) => besideOf(i, 3))).toEqual(["left", "beneath", "right"]);
    expect(besideOf(0, 1)).toBe("beneath");
  });

  it("fit the phase", () => {
    expect(wordOf("go_on", "between")).toBe("play.choice.go_on.between");
    expect(wordOf("go_on", "paused")).toBe("play.choice.go_on");
  });
});
