// A paddle is over the water on the way ahead and in it while it pulls, on its own side.
import { Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { Paddle } from "./paddle";
import { WATER_Y } from "./water";

const hand = new Vector3(0.2, -0.15, -0.4);

function moved(outward: 1 | -1, pulls: boolean): Paddle {
  const paddle = new Paddle(outward);
  for (let k = 0; k < 100; k++) paddle.animate(0.02, hand, pulls);
  return paddle;
}

describe("Paddle", () => {
  it("dips while it pulls", () => {
    expect([moved(1, true).isDipped, moved(1, false).isDipped]).toEqual([true, false]);
    expect(moved(1, true).tip.y).toBeLessThan(WATER_Y);
    expect(moved(1, false).tip.y).toBeGreaterThan(WATER_Y);
  });

  it("reaches out on its own side", () => {
    expect(moved(1, true).tip.x).toBeGreaterThan(hand.x);
    expect(moved(-1, true).tip.x).toBeLessThan(hand.x);
  });

  it("is not there while its hand is not seen", () => {
    const paddle = moved(1, true);
    paddle.animate(0.02, null, true);
    expect(paddle.group.visible).toBe(false);
  });
});
