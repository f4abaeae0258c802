import { expect, test } from "vitest";
import { weeksSince } from "./calendar";

const TODAY = new Date(2026, 4, 4);

test("the calendar shows the plan's weeks, but not too few nor too many", () => {
  expect(weeksSince(new Date(2026, 3, 6), TODAY)).toBe(5);
  expect(weeksSince(TODAY, TODAY)).toBe(4);
  expect(weeksSince(new Date(2020, 0, 1), TODAY)).toBe(26);
});
