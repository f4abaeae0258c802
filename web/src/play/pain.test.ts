import { expect, test } from "vitest";
import { isPainKey } from "./pain";

const pressed = (key: string, tagName = "BODY") => isPainKey({ key, target: { tagName } as HTMLElement });

test("the keys of a switch stop for pain, whatever has the focus", () => {
  for (const tagName of ["BODY", "BUTTON", "A"]) {
    expect(pressed(" ", tagName)).toBe(true);
    expect(pressed("Escape", tagName)).toBe(true);
  }
  expect(pressed("Enter")).toBe(true);
});

test("Enter presses the button that has the focus, and letters do nothing", () => {
  expect(pressed("Enter", "BUTTON")).toBe(false);
  expect(pressed("Enter", "A")).toBe(false);
  expect(pressed("a")).toBe(false);
});
