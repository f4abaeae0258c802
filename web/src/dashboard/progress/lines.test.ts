import { describe, expect, test } from "vitest";
import type { ProgressLine } from "../../api/types";
import { familiesOf, firstFamilies, isDriven, mainLine, saidOf, saidOfScores, verdictWords } from "./lines";

const line = (name: string, rest: Partial<ProgressLine> = {}, values: readonly number[] = [1, 1.4]): ProgressLine => ({
  name,
  joint: "",
  side: "",
  label: `metric.${name}`,
  unit: "rad",
  trust: "good",
  trust_key: "trust.exact",
  better: "more",
  points: values.map((value, index) => ({
    session_id: index + 1,
    at: `2026-03-0${index + 1}T09:00:00Z`,
    value,
    sem: 0.05,
    caveat: "",
  })),
  difference: 0.4,
  mdc: 0.2,
  mdc_is_published: false,
  verdict: "better",
  ...rest,
});

const driven = (one: ProgressLine): ProgressLine => ({
  ...one,
  verdict: "unknown",
  points: one.points.map((point) => ({ ...point, caveat: "caveat.passive_drive" })),
});

const HEALTHY = line("range_of_movement", { joint: "elbow", side: "right" });
const AFFECTED = line("range_of_movement", { joint: "elbow", side: "left" });

describe("figures", () => {
  test("of both arms stand together, in the order of the service", () => {
    const families = familiesOf([line("sparc"), HEALTHY, AFFECTED]);
    expect(families.map(({ id, lines }) => [id, lines.length])).toEqual([
      ["sparc/", 1],
      ["range_of_movement/elbow", 2],
    ]);
  });

  test("that say most come first, whatever their place", () => {
    const families = familiesOf([line("sparc"), HEALTHY, line("own_work"), line("own_range", { joint: "elbow" })]);
    expect(firstFamilies(families).map(({ name }) => name)).toEqual(["own_range", "range_of_movement", "sparc"]);
  });
});

test("six games leave room for the other figures that say most", () => {
  const games = ["reach", "trace", "catch", "everyday", "wipe", "row"];
  const families = familiesOf([...games.map((joint) => line("game_level", { joint })), line("sparc")]);
  expect(firstFamilies(families).map(({ name }) => name)).toEqual(["game_level", "game_level", "sparc"]);
});

describe("the arm that is judged", () => {
  test("is the affected one", () => {
    const [family] = familiesOf([HEALTHY, AFFECTED]);
    expect(family && mainLine(family, "left")).toBe(AFFECTED);
  });

  test("is the healthy one where the drive moved the other", () => {
    expect(isDriven(driven(AFFECTED))).toBe(true);
    const [family] = familiesOf([HEALTHY, driven(AFFECTED)]);
    expect(family && mainLine(family, "left")).toBe(HEALTHY);
  });
});

describe("what is said", () => {
  test("names the change and what would be chance", () => {
    expect(verdictWords(AFFECTED)).toContain("+23°");
    expect(verdictWords(AFFECTED)).toContain("11°");
  });

  test("gives the reason where nothing can be said", () => {
    const silent = line("sparc", { verdict: "unknown", mdc: null });
    expect(saidOf({ ...silent, points: silent.points.slice(0, 1) })).toBe("one");
    expect(saidOf(driven(AFFECTED))).toBe("driven");
    expect(saidOf({ ...silent, trust: "poor" })).toBe("poor");
    expect(saidOf(silent)).toBe("unknown");
  });
});

test("scores have changed by more than chance only where the test's own variation is known and exceeded", () => {
  expect(saidOfScores([31, 35, 41], 6.82)).toBe("better");
  expect(saidOfScores([41, 31], 6.82)).toBe("worse");
  expect(saidOfScores([31, 36], 6.82)).toBe("unchanged");
  expect(saidOfScores([31, 41], null)).toBe("unknown");
  expect(saidOfScores([31], 6.82)).toBe("one");
});
