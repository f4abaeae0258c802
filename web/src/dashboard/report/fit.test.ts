import { describe, expect, test } from "vitest";
import { largestScale, PAGE_HEIGHT_PX } from "./fit";

describe("a report", () => {
  test("that fits is printed as it is", () => {
    expect(largestScale(() => PAGE_HEIGHT_PX)).toBe(1);
  });

  test.each([1.1, 1.5, 2])("%f pages long is printed just so much smaller that it fits", (pages) => {
    const heightAt = (scale: number) => pages * PAGE_HEIGHT_PX * scale; // longer lines, fewer of them
    const scale = largestScale(heightAt);
    expect(heightAt(scale) * scale).toBeLessThanOrEqual(PAGE_HEIGHT_PX);
    expect(scale).toBeCloseTo(Math.sqrt(1 / pages), 1);
  });
});
