import { describe, expect, it } from "vitest";
import { Pace } from "./pace";

/** Draws for `duration_s` at `fps`; how often the picture was to become coarser. */
function run(pace: Pace, fps: number, duration_s: number, from_s = 0): number {
  let coarser = 0;
  for (let i = 0; i <= duration_s * fps; i++) coarser += pace.frame(from_s + i / fps) ? 1 : 0;
  return coarser;
}

describe("Pace", () => {
  it("leaves a fast screen alone", () => {
    const pace = new Pace(60);
    expect(run(pace, 60, 10)).toBe(0);
    expect(pace.fps).toBeCloseTo(60, 0);
  });

  it("asks a slow screen to draw less, a step every two seconds", () => {
    expect(run(new Pace(60), 20, 8.5)).toBe(4);
  });

  it("forgives one slow second", () => {
    const pace = new Pace(60);
    run(pace, 60, 3);
    run(pace, 20, 1.2, 3.02);
    expect(run(pace, 60, 3, 4.3)).toBe(0);
  });

  it("takes a hidden window for no slow screen", () => {
    const pace = new Pace(60);
    expect([0, 1, 2, 3, 4, 5, 6].map((now_s) => pace.frame(now_s))).not.toContain(true);
  });
});
