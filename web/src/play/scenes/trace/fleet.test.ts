// Lanterns brought home lie on the lake, apart from one another, where the eyes see them.
import { describe, expect, it } from "vitest";
import { berth, MOST } from "./fleet";
import { WATER_Y } from "./lake";

const berths = Array.from({ length: MOST }, (_, i) => berth(i));

describe("where lanterns come to rest", () => {
  it("is on the water beyond the jetty and inside the picture", () => {
    for (const { x, y, z } of berths) {
      expect(y).toBeGreaterThan(WATER_Y);
      expect(z).toBeLessThan(-1.5);
      expect(Math.abs(x / z)).toBeLessThan(0.9);
    }
  });

  it("is a place of its own for each", () => {
    const gaps = berths.flatMap((one, i) => berths.slice(i + 1).map((other) => one.distanceTo(other)));
    expect(Math.min(...gaps)).toBeGreaterThan(0.13);
  });
});
