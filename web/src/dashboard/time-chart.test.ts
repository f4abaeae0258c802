import { describe, expect, test } from "vitest";
import { niceTicks, xOf } from "./time-chart";

const spans: readonly [number, number][] = [
  [0, 1],
  [-1.83, -1.41],
  [0.0123, 0.0131],
  [12, 388],
];

describe("an axis", () => {
  test.each(spans)("from %f to %f encloses its values with few round numbers", (from, to) => {
    const ticks = niceTicks({ from, to });
    expect(ticks[0]).toBeLessThanOrEqual(from);
    expect(ticks.at(-1)).toBeGreaterThanOrEqual(to);
    expect(ticks.length).toBeGreaterThanOrEqual(3);
    expect(ticks.length).toBeLessThanOrEqual(8);
  });

  test("of days lies alike in every chart of one width", () => {
    const x = xOf(500, { from: 0, to: 100 });
    expect(x(50)).toBeCloseTo((x(0) + x(100)) / 2);
  });
});
