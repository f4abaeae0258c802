// The bar between the hands says which one hangs back, and which way it has to go.
import { Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { LevelBar } from "./level-bar";

const right = new Vector3(0.2, -0.1, -0.5);
const left = new Vector3(-0.2, -0.1, -0.35);

function shown(state: string, ahead = true): LevelBar {
  const bar = new LevelBar();
  bar.show(right, left, state, ahead);
  return bar;
}

describe("LevelBar", () => {
  it("carries the diamond while the hands are even and the arrow while they are not", () => {
    expect([shown("even").diamond.visible, shown("even").arrow.visible]).toEqual([true, false]);
    expect([shown("left").diamond.visible, shown("left").arrow.visible]).toEqual([false, true]);
  });

  it("has its arrow at the hand that hangs back, pointing where it has to go", () => {
    const reaching = shown("left").arrow.position;
    expect(reaching.x).toBe(left.x);
    expect(reaching.z).toBeLessThan(left.z);
    const pulling = shown("right", false).arrow.position;
    expect(pulling.x).toBe(right.x);
    expect(pulling.z).toBeGreaterThan(right.z);
  });

  it("is not there while the healthy hand is not seen", () => {
    expect(shown("unseen").group.visible).toBe(false);
  });
});
