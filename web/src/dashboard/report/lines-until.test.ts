import { describe, expect, test } from "vitest";
import type { ProgressLine } from "../../api/types";
import { linesUntil, measuredIn, shortened } from "./lines-until";

const line = (name: string, sessions: readonly number[]): ProgressLine => ({
  name,
  joint: "",
  side: "",
  label: "",
  unit: "s",
  trust: "good",
  trust_key: "",
  better: "",
  points: sessions.map((session) => ({
    session_id: session,
    at: `2026-03-0${session}T09:00:00Z`,
    value: session,
    sem: null,
    caveat: "",
  })),
  difference: null,
  mdc: null,
  mdc_is_published: false,
  verdict: "unknown",
});

describe("a session's report", () => {
  const lines = [line("sparc", [1, 2, 3]), line("accuracy", [3]), line("movement_time", [1])];

  test("knows nothing of later sessions", () => {
    const known = linesUntil(lines, "2026-03-02T09:00:00Z");
    expect(known.map(({ name, points }) => `${name} ${points.length}`)).toEqual(["sparc 2", "movement_time 1"]);
  });

  test("tells only what was measured in it", () => {
    const known = linesUntil(lines, "2026-03-02T09:00:00Z");
    expect(measuredIn(known, 2).map(({ name }) => name)).toEqual(["sparc"]);
  });
});

test("a long note is cut where the page ends, a short one is not", () => {
  expect(shortened("abc", 3)).toBe("abc");
  expect(shortened("abcd", 3)).toBe("abc …");
});
