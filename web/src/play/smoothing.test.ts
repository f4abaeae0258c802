import { describe, expect, it } from "vitest";
import { ClockOffset, Follower, MAX_AHEAD_S } from "./smoothing";

/** A hand that swings ±0.3 m at 0.5 Hz: peak speed 0.94 m/s, a brisk reach. */
const swing = (t_s: number) => 0.3 * Math.sin(Math.PI * t_s);

/** Deterministic jitter 0..1. */
function jitter(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state * 1103515245 + 12345) % 2147483648;
    return state / 2147483648;
  };
}

/** Feeds 30 Hz ticks with 0–15 ms of jitter and draws at 60 Hz; says what was shown when. */
function play(lead_s = 1000): { t_s: number; shown: number }[] {
  const follower = new Follower();
  const late = jitter(7);
  const ticks = Array.from({ length: 120 }, (_, i) => ({ t_s: lead_s + i / 30, at_s: 5 + i / 30 + late() * 0.015 }));
  const frames: { t_s: number; shown: number }[] = [];
  let next = 0;
  for (let frame = 1; frame < 220; frame++) {
    const now_s = 5 + frame / 60;
    for (let tick = ticks[next]; tick && tick.at_s <= now_s; tick = ticks[++next]) {
      follower.take(tick.t_s, [swing(tick.t_s - lead_s)], tick.at_s);
    }
    const shown = follower.at(now_s);
    if (shown) frames.push({ t_s: now_s - 5, shown: shown[0] ?? Number.NaN });
  }
  return frames.filter((frame) => frame.t_s > 0.5);
}

describe("Follower", () => {
  it("shows a moving hand within 15 mm (16 ms of its way) of where it is, though ticks come at 30 Hz with jitter", () => {
    const worst = Math.max(...play().map(({ t_s, shown }) => Math.abs(shown - swing(t_s))));
    expect(worst).toBeLessThan(0.015);
  });

  it("moves evenly: no frame's step is more than twice the fastest true step", () => {
    const frames = play();
    const steps = frames.slice(1).map(({ shown }, i) => Math.abs(shown - (frames[i]?.shown ?? 0)));
    expect(Math.max(...steps)).toBeLessThan((2 * 0.3 * Math.PI) / 60);
  });

  it("never runs further ahead than one frame when ticks cease", () => {
    const follower = new Follower();
    for (let i = 0; i <= 10; i++) follower.take(i / 100, [i / 100], i / 100);
    expect(follower.at(5)?.[0]).toBeCloseTo(0.1 + MAX_AHEAD_S, 6);
  });

  it("stands still while the arm stands still", () => {
    const follower = new Follower();
    for (let i = 0; i <= 10; i++) follower.take(i / 100, [0.4, -0.2], i / 100);
    expect(follower.at(0.2)).toEqual([0.4, -0.2]);
  });

  it("shows a far jump at once and without overshoot", () => {
    const follower = new Follower();
    follower.take(0, [0], 0);
    follower.take(0.01, [1], 0.01);
    expect(follower.at(0.02)).toEqual([1]);
  });

  it("leaves out ticks that arrive out of order", () => {
    const follower = new Follower();
    follower.take(1, [0.1], 1);
    follower.take(0.9, [0.2], 1.01);
    expect(follower.at(1.02)).toEqual([0.1]);
  });

  it("starts again when the station's clock starts again", () => {
    const follower = new Follower();
    follower.take(900, [0.1], 1);
    follower.take(3, [0.15], 2);
    expect(follower.at(2)).toEqual([0.15]);
  });

  it("has nothing to show before the first tick", () => {
    expect(new Follower().at(1)).toBeNull();
  });
});

describe("ClockOffset", () => {
  it("keeps to the fastest delivery", () => {
    const clock = new ClockOffset();
    clock.take(100, 1.02);
    clock.take(100.1, 1.101);
    clock.take(100.2, 1.25);
    expect(clock.stationTime(1.25)).toBeCloseTo(100.249, 3);
  });
});
