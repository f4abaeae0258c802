import { expect, test } from "vitest";
import type { PatientToday } from "../../api/types";
import { matching } from "./search";

const rows = ["Wang Li", "Jörg Müller", "王丽"].map((name) => ({ name }) as PatientToday);
const found = (sought: string) => matching(rows, sought).map(({ name }) => name);

test("a part of the name is enough, in any order, case and accent", () => {
  expect(found("li wa")).toEqual(["Wang Li"]);
  expect(found("muller")).toEqual(["Jörg Müller"]);
  expect(found("丽")).toEqual(["王丽"]);
});

test("what is in no name finds nobody, and nothing sought finds all", () => {
  expect(found("zoe")).toEqual([]);
  expect(found(" ")).toHaveLength(3);
});
