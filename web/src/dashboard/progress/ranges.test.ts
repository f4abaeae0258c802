import { describe, expect, test } from "vitest";
import type { ProgressLine } from "../../api/types";
import { rangesOf, widthOf } from "./ranges";

const line = (name: string, values: readonly number[], caveat = ""): ProgressLine => ({
  name,
  joint: "elbow",
  side: "left",
  label: "",
  unit: "rad",
  trust: "fair",
  trust_key: "",
  better: "",
  points: values.map((value, index) => ({
    session_id: index + 1,
    at: "2026-03-01T09:00:00Z",
    value,
    sem: null,
    caveat,
  })),
  difference: null,
  mdc: null,
  mdc_is_published: false,
  verdict: "unknown",
});

describe("an arm's range", () => {
  test("is told of the first, the last and the widest session", () => {
    const ranges = rangesOf(
      [line("range_lowest", [0.2, 0.1, 0.1]), line("range_highest", [1, 1.6, 1.4])],
      "elbow",
      "left",
    );
    expect([ranges?.first.session, ranges?.best.session, ranges?.last.session]).toEqual([1, 2, 3]);
    expect(ranges && widthOf(ranges.best)).toBeCloseTo(1.5);
    expect(ranges?.isDriven).toBe(false);
  });

  test("is what it reached itself, where that was measured", () => {
    const moved = [
      line("range_lowest", [0, 0], "caveat.passive_drive"),
      line("range_highest", [2, 2], "caveat.passive_drive"),
    ];
    const own = [line("own_range_lowest", [0.3]), line("own_range_highest", [0.9])];
    expect(rangesOf(moved, "elbow", "left")?.isDriven).toBe(true);
    expect(rangesOf([...moved, ...own], "elbow", "left")).toMatchObject({ isOwn: true, isDriven: false });
  });

  test("is not made up where an end is missing, or for the other arm", () => {
    expect(rangesOf([line("range_lowest", [0.2])], "elbow", "left")).toBeNull();
    expect(rangesOf([line("range_lowest", [0.2]), line("range_highest", [1])], "elbow", "right")).toBeNull();
  });
});
