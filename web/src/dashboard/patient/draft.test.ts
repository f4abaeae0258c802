import { describe, expect, test } from "vitest";
import type { Patient } from "../../api/types";
import { draftOf, emptyDraft, formOf, rangeDeg } from "./draft";

const joint = { min_rad: 0, max_rad: (135 * Math.PI) / 180 };
const range = { plane: joint, elevation: joint, rotation: joint, elbow: joint };
const complete = () => ({ ...emptyDraft(range), name: " Li ", healthySide: "left" as const });

describe("a patient's form", () => {
  test("cannot be sent without a name or a healthy side", () => {
    expect(formOf({ ...complete(), name: "  " })).toBeNull();
    expect(formOf({ ...complete(), healthySide: null })).toBeNull();
  });

  test("cannot be sent with a range that is none", () => {
    const draft = complete();
    expect(formOf({ ...draft, range: { ...draft.range, elbow: { min: "90", max: "20" } } })).toBeNull();
  });

  test("sends radians and trims the name", () => {
    const form = formOf(complete());
    expect(form?.name).toBe("Li");
    expect(form?.passive_range?.elbow?.max_rad).toBeCloseTo((135 * Math.PI) / 180);
  });

  test("comes back as it was sent", () => {
    const form = formOf(complete());
    const stored = { ...form, id: 1, created_at: "", updated_at: "" } as Patient;
    expect(formOf(draftOf(stored))).toEqual(form);
  });
});

describe("a range", () => {
  test.each([
    ["", "10"],
    ["10", ""],
    ["x", "10"],
    ["10", "10"],
    ["-181", "10"],
    ["10", "181"],
  ])("from %j to %j is none", (min, max) => {
    expect(rangeDeg({ min, max })).toBeNull();
  });
});
