import { describe, expect, test } from "vitest";
import { en } from "./en";
import { fill, isKey, type Key } from "./index";
import { zh } from "./zh";

const KEYS = Object.keys(en) as Key[];
const placesIn = (text: string) => [...text.matchAll(/\{(\w+)\}/g)].map(([, name]) => name).sort();

describe("the two languages", () => {
  test("say something for every key", () => {
    for (const key of KEYS) {
      expect(en[key].trim(), key).not.toBe("");
      expect(zh[key].trim(), key).not.toBe("");
    }
  });

  test("leave the same places for values", () => {
    for (const key of KEYS) expect(placesIn(zh[key]), key).toEqual(placesIn(en[key]));
  });
});

describe("a text", () => {
  test("takes its values, and shows a place that got none", () => {
    expect(fill("{a} of {b}", { a: 1 })).toBe("1 of {b}");
  });

  test("is known by its key only", () => {
    expect(isKey("app.name")).toBe(true);
    expect(isKey("toString")).toBe(false);
  });
});
