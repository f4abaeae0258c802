import { describe, expect, test } from "vitest";
import { emptyDraft, formOf, isOffScale } from "./draft";
import { GREATEST, KINDS } from "./scales";

const TODAY = new Date(2026, 4, 4);
const DRAFT = { ...emptyDraft("left", "Dr. Lin", TODAY), value: "31" };

describe("a score", () => {
  test("is sent as it was typed", () => {
    expect(formOf({ ...DRAFT, kind: "arat" }, TODAY)).toEqual({
      kind: "arat",
      side: "left",
      value: 31,
      on: "2026-05-04",
      rater: "Dr. Lin",
      note: "",
    });
  });

  test.each(KINDS)("of %s reaches to the end of its scale and not beyond", (kind) => {
    expect(formOf({ ...DRAFT, kind, value: String(GREATEST[kind]) }, TODAY)).not.toBeNull();
    expect(formOf({ ...DRAFT, kind, value: String(GREATEST[kind] + 1) }, TODAY)).toBeNull();
    expect(isOffScale({ kind, value: String(GREATEST[kind] + 1) })).toBe(true);
  });

  test.each(["-1", "12.5", "many"])("of %j is off its scale", (value) => {
    expect(isOffScale({ kind: "arat", value })).toBe(true);
  });

  test("that is not typed yet is neither wrong nor sent", () => {
    expect(isOffScale({ ...DRAFT, value: " " })).toBe(false);
    expect(formOf({ ...DRAFT, value: " " }, TODAY)).toBeNull();
  });

  test("of tomorrow, or of nobody, is not sent", () => {
    expect(formOf({ ...DRAFT, on: "2026-05-05" }, TODAY)).toBeNull();
    expect(formOf({ ...DRAFT, rater: "  " }, TODAY)).toBeNull();
  });
});
