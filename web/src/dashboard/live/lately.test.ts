import { expect, test } from "vitest";
import { Lately } from "./lately";

test("what one tick says can be read for a while, then is gone", () => {
  const lately = new Lately();
  lately.take(["elbow: at the end of its range"], 10);
  lately.take([], 10.1);
  expect(lately.at(12)).toEqual(["elbow: at the end of its range"]);
  expect(lately.at(13)).toEqual([]);
});

test("what is said again keeps its place", () => {
  const lately = new Lately();
  lately.take(["a", "b"], 0);
  lately.take(["b"], 1);
  lately.take(["a"], 2);
  expect(lately.at(3)).toEqual(["a", "b"]);
});
