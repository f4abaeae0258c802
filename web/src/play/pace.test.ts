import { describe, expect, it } from "vitest";
import { effortsOf, Pace } from "./pace";

const SOFTWARE = effortsOf(1, true);

/** A machine that gives at most `most` frames a second, for `duration_s`; returns when it ended. */
function run(pace: Pace, most: (pixels: number) => number, duration_s: number, from_s = 0): number {
  let now_s = from_s;
  while (now_s < from_s + duration_s) {
    now_s += 1 / Math.min(most(pace.effort.pixels), pace.effort.fps);
    pace.frame(now_s);
  }
  return now_s;
}

describe("Pace", () => {
  it("asks for everything from a machine that gives it", () => {
    const pace = new Pace(SOFTWARE, 1);
    run(pace, () => 60, 30);
    expect(pace.effort).toEqual({ fps: 60, pixels: 1 });
    expect(pace.fps).toBeCloseTo(60, 0);
  });

  it("draws fewer pixels before it draws fewer frames", () => {
    const pace = new Pace(SOFTWARE, 1);
    run(pace, (pixels) => (pixels > 0.6 ? 40 : 60), 8);
    expect(pace.effort).toEqual({ fps: 60, pixels: 0.5 });
  });

  it("falls back to half the frames where pixels do not help", () => {
    const pace = new Pace(SOFTWARE, 1);
    run(pace, () => 36, 12);
    expect(pace.effort.fps).toBe(30);
  });

  it("forgives one slow second", () => {
    const pace = new Pace(SOFTWARE, 1);
    const now_s = run(
      pace,
      () => 20,
      1.1,
      run(pace, () => 60, 3),
    );
    run(pace, () => 60, 3, now_s);
    expect(pace.effort).toEqual(SOFTWARE[1]);
  });

  it("comes back when the machine is free again, later each time that it was too much", () => {
    const pace = new Pace(SOFTWARE, 1);
    const busy_s = run(pace, () => 30, 12);
    const low = pace.effort;
    const soon_s = run(pace, () => 60, 8, busy_s);
    expect(pace.effort).toEqual(low);
    run(pace, () => 60, 400, soon_s);
    expect(pace.effort).toEqual(SOFTWARE[0]);
  });

  it("takes less where others on this machine come too late", () => {
    const pace = new Pace(SOFTWARE, 1);
    for (let i = 0; i < 150; i++) {
      pace.strain(i % 10 === 0 ? 1 : 0);
      pace.frame(i / 60);
    }
    expect(pace.effort).toEqual(SOFTWARE[2]);
  });

  it("takes a hidden window for no slow screen", () => {
    const pace = new Pace(SOFTWARE, 1);
    for (const now_s of [0, 1, 2, 3, 4, 5, 6]) pace.frame(now_s);
    expect(pace.effort).toEqual(SOFTWARE[1]);
  });

  it("lets no frame be drawn sooner than it is due", () => {
    const pace = new Pace([{ fps: 30, pixels: 0.5 }], 0);
    pace.frame(1);
    expect([pace.isDue(1 + 1 / 60), pace.isDue(1 + 1 / 30)]).toEqual([false, true]);
  });
});

describe("effortsOf", () => {
  it("never asks for fewer than half of the page's pixels, and always ends at 30 frames", () => {
    for (const software of [true, false]) {
      const efforts = effortsOf(1.5, software);
      expect(Math.min(...efforts.map(({ pixels }) => pixels))).toBeGreaterThanOrEqual(0.5);
      expect(efforts.at(-1)?.fps).toBe(30);
    }
  });
});
