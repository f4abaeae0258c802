// What the rules say of the pane, as the glass needs it: how misted each cell is, and which belong to the patch.
import { Vector3 } from "three";
import type { ThingView } from "../../changes";

/** Row by row from the top, each from the left. */
export interface Cells {
  /** 1 = mist .. 0 = clear. */
  readonly mist: readonly number[];
  /** Whether the cell is still to be wiped in the patch. */
  readonly patch: readonly boolean[];
}

export const NO_CELLS: Cells = { mist: [], patch: [] };

export function gridOf(pane: ThingView): { readonly columns: number; readonly rows: number } {
  const rows = pane.state.split("/");
  return { columns: rows[0]?.length ?? 1, rows: rows.length };
}

/** `onGlass` takes a place of the trunk frame to the glass's own: from its middle, x right, y up. It may write to its argument. */
export function cellsOf(pane: ThingView, things: readonly ThingView[], onGlass: (place: Vector3) => Vector3): Cells {
  const { columns, rows } = gridOf(pane);
  const signs = [...pane.state.replaceAll("/", "")];
  const patch = signs.map(() => false);
  for (const cell of things.filter((thing) => thing.kind === "cell" && thing.progress < 1)) {
    const at = onGlass(new Vector3(...cell.position)).divideScalar(2 * pane.radius_m);
    const row = Math.round((rows - 1) / 2 - at.y);
    patch[row * columns + Math.round(at.x + (columns - 1) / 2)] = true;
  }
  return { mist: mistOf(signs, columns), patch };
}

/** A cell that is not to be wiped clears with the nearest one that is, so that all is misted at first. */
function mistOf(signs: readonly string[], columns: number): number[] {
  const wiped = signs.flatMap((sign, i) => (sign === "." ? [] : [i]));
  const apart = (i: number, k: number) =>
    Math.hypot((i % columns) - (k % columns), Math.floor(i / columns) - Math.floor(k / columns));
  return signs.map((sign, i) => {
    const like = sign === "." ? wiped.reduce((best, k) => (apart(i, k) < apart(i, best) ? k : best), wiped[0] ?? i) : i;
    return 1 - Number(signs[like]) / 9;
  });
}
