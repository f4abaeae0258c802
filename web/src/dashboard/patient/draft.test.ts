import { describe, expect, test } from "vitest";
import type { Patient, PatientLimits } from "../../api/types";
import { draftOf, emptyDraft, formOf, rangeDeg, torqueNm } from "./draft";

const joint = { min_rad: 0, max_rad: (135 * Math.PI) / 180 };
const force = { torque_nm: 15, resistance_nm: 6.5 };
const limits: PatientLimits = {
  passive_range: { plane: joint, elevation: joint, rotation: joint, elbow: joint },
  force_limits: { plane: force, elevation: force, rotation: force, elbow: force },
  assist_level_most: 0.8,
};
const complete = () => ({ ...emptyDraft(limits), name: " Li ", healthySide: "left" as const });
const withElbow = (part: object) => {
  const draft = complete();
  return { ...draft, joints: { ...draft.joints, elbow: { ...draft.joints.elbow, ...part } } };
};

describe("a patient's form", () => {
  test("cannot be sent without a name or a healthy side", () => {
    expect(formOf({ ...complete(), name: "  " })).toBeNull();
    expect(formOf({ ...complete(), healthySide: null })).toBeNull();
  });

  test("cannot be sent with a range or a torque that is none", () => {
    expect(formOf(withElbow({ min: "90", max: "20" }))).toBeNull();
    expect(formOf(withElbow({ torque: "" }))).toBeNull();
    expect(formOf(withElbow({ resistance: "0" }))).toBeNull();
  });

  test("sends radians and trims the name", () => {
    const form = formOf(complete());
    expect(form?.name).toBe("Li");
    expect(form?.passive_range?.elbow?.max_rad).toBeCloseTo((135 * Math.PI) / 180);
    expect(form?.force_limits?.elbow).toEqual(force);
    expect(form?.assist_level_most).toBe(0.8);
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

test("a torque is more than nothing and no more than the largest", () => {
  expect(torqueNm("6.5")).toBe(6.5);
  for (const wrong of ["", "0", "-1", "61", "x"]) expect(torqueNm(wrong), wrong).toBeNull();
});
