// Butterflies that were caught live beyond the terrace, apart from one another, where the eyes see them.
import { describe, expect, it } from "vitest";
import { numberOf } from "./flight";
import { homeOf, MOST } from "./flock";
import { isOverTerrace } from "./valley";

const homes = Array.from({ length: MOST }, (_, i) => homeOf(i));

describe("where caught butterflies live", () => {
  it("is beyond the terrace and inside the picture", () => {
    for (const { x, y, z } of homes) {
      expect(isOverTerrace(x, z)).toBe(false);
      expect(z).toBeLessThan(-2);
      expect(Math.abs(x / z)).toBeLessThan(1);
      expect(y).toBeLessThan(0.4);
    }
  });

  it("is a place of its own for each", () => {
    const gaps = homes.flatMap((one, i) => homes.slice(i + 1).map((other) => one.distanceTo(other)));
    expect(Math.min(...gaps)).toBeGreaterThan(0.1);
  });
});

describe("numberOf", () => {
  it("is the same for a butterfly and its place", () => {
    expect([1, 2, 3, 4].map(numberOf)).toEqual([1, 1, 2, 2]);
  });
});
