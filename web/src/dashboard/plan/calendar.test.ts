import { expect, test } from "vitest";
import { weeksShown, weeksSince } from "./calendar";

const TODAY = new Date(2026, 4, 4);
const LONG_AGO = new Date(2020, 0, 1);

test("the calendar shows the plan's weeks, but not too few nor too many", () => {
  expect(weeksShown(new Date(2026, 3, 6), TODAY)).toBe(5);
  expect(weeksShown(TODAY, TODAY)).toBe(4);
  expect(weeksShown(LONG_AGO, TODAY)).toBe(26);
});

test("a report counts all of the plan's weeks, and one where it is still to come", () => {
  expect(weeksSince(LONG_AGO, TODAY)).toBeGreaterThan(300);
  expect(weeksSince(new Date(2026, 5, 1), TODAY)).toBe(1);
});
