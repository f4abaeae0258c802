import { describe, expect, test } from "vitest";
import { angleText, degrees, duration, figure, radians, secondsBetween, thousandths } from "./format";

describe("figures", () => {
  test("what is unknown is a dash, never NaN", () => {
    for (const nothing of [null, undefined, Number.NaN, Number.POSITIVE_INFINITY]) expect(figure(nothing)).toBe("–");
    expect(angleText(null)).toBe("–");
    expect(thousandths(null)).toBe("–");
  });

  test("a small negative number is zero without a sign", () => {
    expect(figure(-0.2)).toBe("0");
    expect(figure(-0.04, 1)).toBe("0.0");
  });

  test("negative numbers carry a real minus sign", () => {
    expect(figure(-12.3, 1)).toBe("−12.3");
  });

  test("degrees and radians undo one another", () => {
    for (const angle of [-180, -1, 0, 37.5, 180]) expect(degrees(radians(angle))).toBeCloseTo(angle, 10);
  });

  test("seconds become milliseconds", () => {
    expect(thousandths(0.137)).toBe("137");
  });
});

describe("time", () => {
  test("minutes and two-digit seconds", () => {
    expect(duration(0)).toBe("0:00");
    expect(duration(67.4)).toBe("1:07");
    expect(duration(59.6)).toBe("1:00");
    expect(duration(-3)).toBe("0:00");
  });

  test("a session that has not ended has no length", () => {
    expect(secondsBetween("2026-01-01T10:00:00Z", null)).toBeNull();
    expect(secondsBetween("2026-01-01T10:00:00Z", "2026-01-01T10:05:00Z")).toBe(300);
  });
});
