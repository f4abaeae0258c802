import { expect, test } from "vitest";
import { byReason, isClamped } from "./clamps";

test("a clamped joint is the one that the station's words begin with", () => {
  const clamped = ["elbow: at the end of its range"];
  expect(isClamped("elbow", clamped)).toBe(true);
  expect(isClamped("elevation", clamped)).toBe(false);
});

test("a reason is said once, with the joints that it is about", () => {
  const clamped = ["plane: at the end of its range", "elbow: held", "elevation: at the end of its range", "all slow"];
  expect(byReason(clamped)).toEqual(["At the end of its range (Direction, Elevation)", "Held (Elbow)", "All slow"]);
});
