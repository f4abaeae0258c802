import { expect, test } from "vitest";
import { missingFor } from "./missing";

const signed = { healthy_side: "right", limits_set_by: "lin" } as const;

test("nothing is missing once the side is confirmed and the limits are signed for", () => {
  expect(missingFor(signed, "left")).toEqual([]);
});

test("everything that is missing is named", () => {
  expect(missingFor({ ...signed, limits_set_by: "" }, null)).toEqual([
    "prepare.limits.missing",
    "prepare.side.missing",
  ]);
});

test("the healthy side cannot be confirmed as the affected one", () => {
  expect(missingFor(signed, "right")).toEqual(["prepare.side.wrong"]);
});
