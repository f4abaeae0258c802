import { describe, expect, test } from "vitest";
import type { Plan } from "../../api/types";
import { isoDay } from "../format";
import { draftOf, formOf, moved, newDraft, type PlanDraft, repetitionsOf, sumOf } from "./draft";

const PLAN: Plan = {
  patient_id: 3,
  exercises: [
    { game: "reach", minutes: 6, level: null, pinned: false },
    { game: "trace", minutes: 4.5, level: 0.4, pinned: false },
    { game: "catch", minutes: 3, level: 0.7, pinned: true },
  ],
  repetitions: 120,
  sessions_per_week: 3,
  weeks: 4,
  starts_on: "2026-03-02",
  note: "the elbow first",
  updated_by: "Dr. Lin",
  updated_at: "2026-03-01T09:00:00Z",
};

const wrong: readonly [string, Partial<PlanDraft>][] = [
  ["no exercise", { exercises: [] }],
  ["half a session", { perWeek: "1.5" }],
  ["a hundred weeks", { weeks: "100" }],
  ["no beginning", { startsOn: "" }],
  ["words for attempts", { repetitions: "many" }],
];

describe("a plan's form", () => {
  test("sends what was planned, unchanged", () => {
    const { patient_id, updated_by, updated_at, ...form } = PLAN;
    expect(formOf(draftOf(PLAN))).toEqual(form);
  });

  test("of a new plan can be sent as it stands", () => {
    expect(formOf(newDraft(new Date(2026, 2, 2)))?.starts_on).toBe("2026-03-02");
  });

  test.each(wrong)("with %s is not sent", (_, part) => {
    expect(formOf({ ...draftOf(PLAN), ...part })).toBeNull();
  });

  test("with minutes that are no number is not sent", () => {
    const draft = draftOf(PLAN);
    expect(formOf({ ...draft, exercises: draft.exercises.map((one) => ({ ...one, minutes: "0" })) })).toBeNull();
  });

  test("tells no aim from a wrong one", () => {
    expect(repetitionsOf({ repetitions: " " })).toBeNull();
    expect(repetitionsOf({ repetitions: "0" })).toBeUndefined();
  });
});

test("a plan comes to its sessions, minutes and last day", () => {
  const { sessions, minutes, lastDay } = sumOf(PLAN);
  expect([sessions, minutes, isoDay(lastDay)]).toEqual([12, 13.5, "2026-03-29"]);
});

test("an exercise moves down and up again, and never out of the list", () => {
  const { exercises } = draftOf(PLAN);
  const names = (list: typeof exercises) => list.map(({ game }) => game).join(" ");
  expect(names(moved(exercises, 0, 1))).toBe("trace reach catch");
  expect(names(moved(moved(exercises, 0, 1), 1, -1))).toBe("reach trace catch");
  expect(names(moved(exercises, 2, 1))).toBe("reach trace catch");
});
