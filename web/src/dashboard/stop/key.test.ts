import { describe, expect, test } from "vitest";
import { isStopKey } from "./key";

const pressed = (key: string, target: object | null) => isStopKey({ key, target: target as EventTarget | null });

describe("the stop keys", () => {
  test("Escape stops wherever the focus is", () => {
    expect(pressed("Escape", { tagName: "INPUT", type: "text" })).toBe(true);
    expect(pressed("Escape", { tagName: "TEXTAREA" })).toBe(true);
    expect(pressed("Escape", null)).toBe(true);
  });

  test.each([
    ["BUTTON", ""],
    ["SELECT", ""],
    ["BODY", ""],
    ["INPUT", "range"],
    ["INPUT", "number"],
  ])("Space stops on %s %s", (tagName, type) => {
    expect(pressed(" ", { tagName, type })).toBe(true);
  });

  test.each([
    ["TEXTAREA", ""],
    ["INPUT", "text"],
    ["INPUT", "password"],
  ])("Space writes in %s %s", (tagName, type) => {
    expect(pressed(" ", { tagName, type })).toBe(false);
  });

  test("no other key stops", () => {
    expect(pressed("Enter", { tagName: "BODY" })).toBe(false);
  });
});
