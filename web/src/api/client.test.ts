import { expect, test } from "vitest";
import { detailOf } from "./client";

test("the service's own words reach the person", () => {
  const detail = { what: "a", expected: "b", remedy: "c" };
  expect(detailOf({ detail })).toEqual(detail);
});

test.each([undefined, "<html>", { detail: "text" }, {}])("an answer such as %j still gives a sentence", (answer) => {
  expect(detailOf(answer).what).not.toBe("");
});
