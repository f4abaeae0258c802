import { describe, expect, test } from "vitest";
import type { Exercise, Patient } from "../../api/types";
import { firstAnswers, formOf } from "./answers";

const patient = { id: 3, healthy_side: "right", assistance: "assisted", assist_level_most: 0.6 } as Patient;
const planned: Exercise[] = [{ game: "trace", minutes: 4, level: 0.5, pinned: true }];

describe("the first answers", () => {
  test("come from the plan and the patient's page, but never the side", () => {
    expect(firstAnswers(patient, planned)).toMatchObject({ side: null, assistance: "assisted", exercises: planned });
  });

  test("have something to play without a plan", () => {
    expect(firstAnswers(patient, null).exercises).toHaveLength(1);
  });
});

describe("the form", () => {
  test("cannot be sent before somebody has confirmed the side", () => {
    expect(formOf(patient, firstAnswers(patient, planned))).toBeNull();
  });

  test("says what was answered", () => {
    const answers = { ...firstAnswers(patient, planned), side: "left", painBefore: 2 } as const;
    expect(formOf(patient, answers)).toEqual({
      patient_id: 3,
      confirmed_affected_side: "left",
      pain_before: 2,
      exercises: planned,
      assistance: "assisted",
      assist_level: 0.6,
    });
  });
});
