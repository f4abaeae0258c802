import type { Vector3 } from "three";
import { expect, test } from "vitest";
import type { ThingView } from "../../changes";
import { cellsOf, gridOf } from "./cells";

const CELL_M = 0.04;

function pane(state: string): ThingView {
  return { id: 1, kind: "pane", position: [0, 0, 0], radius_m: CELL_M / 2, progress: 0, state, turn_rad: 0 };
}

function cell(x: number, y: number, progress = 0): ThingView {
  return { id: 2, kind: "cell", position: [x, y, 0], radius_m: CELL_M / 2, progress, state: "", turn_rad: 0 };
}

const asItIs = (place: Vector3) => place;

test("the grid is what the rows say", () => {
  expect(gridOf(pane("000/000"))).toEqual({ columns: 3, rows: 2 });
});

test("signs are shares of mist, row by row", () => {
  expect(cellsOf(pane("09/90"), [], asItIs).mist).toEqual([1, 0, 0, 1]);
});

test("a cell that is not to be wiped clears with the nearest one that is", () => {
  expect(cellsOf(pane(".09/..9"), [], asItIs).mist).toEqual([1, 1, 0, 1, 1, 0]);
});

test("cells of the patch are found by their places, but not those that are clear", () => {
  const things = [cell(-CELL_M, CELL_M / 2), cell(CELL_M, -CELL_M / 2), cell(0, CELL_M / 2, 1)];
  expect(cellsOf(pane("000/000"), things, asItIs).patch).toEqual([true, false, false, false, false, true]);
});
