import { describe, expect, test } from "vitest";
import type { JointLimits } from "../../../api/types";
import { angleScale, fromMiddle, partOf, shareOf } from "./scale";

const limits = (min_rad: number, max_rad: number) => ({ joint: "elbow", min_rad, max_rad }) as JointLimits;

describe("an angle bar", () => {
  test("spans the device and marks the patient's part and what the soft margin leaves of it", () => {
    const scale = angleScale(limits(0, 2), limits(-0.5, 2.5), 0.1);
    expect(scale.device).toEqual({ low: -0.5, high: 2.5 });
    expect(scale.patient).toEqual({ low: 0, high: 2 });
    expect(scale.free.low).toBeCloseTo(0.1);
    expect(scale.free.high).toBeCloseTo(1.9);
  });

  test("keeps half of a narrow range free", () => {
    const { free } = angleScale(limits(0, 0.2), undefined, 0.1);
    expect(free.high - free.low).toBeCloseTo(0.1);
  });

  test("never leaves the patient's limits out, whatever the device says", () => {
    expect(angleScale(limits(-1, 1), limits(0, 0.5), 0.1).device).toEqual({ low: -1, high: 1 });
  });

  test("shows what is outside at its end", () => {
    expect(shareOf(5, { low: 0, high: 2 })).toBe(100);
    expect(shareOf(-5, { low: 0, high: 2 })).toBe(0);
    expect(shareOf(0.5, { low: 0, high: 2 })).toBe(25);
    expect(partOf({ low: 0.5, high: 1 }, { low: 0, high: 2 })).toEqual({ left: "25%", width: "25%" });
  });
});

describe("a torque bar", () => {
  test("grows from the middle towards the value's sign and is full at the limit", () => {
    expect(fromMiddle(5, 10)).toEqual({ left: "50%", width: "25%" });
    expect(fromMiddle(-5, 10)).toEqual({ left: "25%", width: "25%" });
    expect(fromMiddle(99, 10)).toEqual({ left: "50%", width: "50%" });
  });
});
