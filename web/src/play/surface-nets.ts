// A smooth closed surface from a signed distance: naive surface nets (Gibson 1998, "Constrained elastic surface nets").
import { BufferAttribute, BufferGeometry } from "three";

/** Signed distance to a shape in metres, negative inside. */
export type Distance = (x: number, y: number, z: number) => number;
type Triple = readonly [number, number, number];

const EDGES: readonly (readonly [number, number])[] = [
  [0, 1],
  [0, 2],
  [0, 4],
  [1, 3],
  [1, 5],
  [2, 3],
  [2, 6],
  [3, 7],
  [4, 5],
  [4, 6],
  [5, 7],
  [6, 7],
];

/** Samples of a distance on a regular grid. */
class Grid {
  readonly size: Triple;
  private readonly values: Float32Array;

  constructor(
    distance: Distance,
    readonly low: Triple,
    high: Triple,
    readonly step: number,
  ) {
    const count = (axis: 0 | 1 | 2) => Math.ceil((high[axis] - low[axis]) / step) + 1;
    this.size = [count(0), count(1), count(2)];
    this.values = new Float32Array(this.size[0] * this.size[1] * this.size[2]);
    this.forEach(this.size, (i, j, k) => {
      this.values[this.index(i, j, k)] = distance(low[0] + i * step, low[1] + j * step, low[2] + k * step);
    });
  }

  index(i: number, j: number, k: number): number {
    return i + this.size[0] * (j + this.size[1] * k);
  }

  /** The distance at the corner (0–7, bits x y z) of a cell. */
  corner(i: number, j: number, k: number, corner: number): number {
    return this.values[this.index(i + (corner & 1), j + ((corner >> 1) & 1), k + (corner >> 2))] ?? 0;
  }

  forEach(size: Triple, visit: (i: number, j: number, k: number) => void): void {
    for (let k = 0; k < size[2]; k++)
      for (let j = 0; j < size[1]; j++) for (let i = 0; i < size[0]; i++) visit(i, j, k);
  }
}

/** The surface where `distance` is zero inside the box `low`–`high`, in cells of `step` metres. */
export function surfaceNets(distance: Distance, low: Triple, high: Triple, step: number): BufferGeometry {
  const grid = new Grid(distance, low, high, step);
  const cells = grid.size.map((n) => n - 1) as unknown as Triple;
  const positions: number[] = [];
  const vertexOfCell = new Map<number, number>();
  grid.forEach(cells, (i, j, k) => {
    const inCell = crossing(grid, i, j, k);
    if (!inCell) return;
    vertexOfCell.set(grid.index(i, j, k), positions.length / 3);
    positions.push(low[0] + (i + inCell[0]) * step, low[1] + (j + inCell[1]) * step, low[2] + (k + inCell[2]) * step);
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute("normal", new BufferAttribute(normals(distance, positions, step), 3));
  geometry.setIndex(faces(grid, cells, vertexOfCell));
  return geometry;
}

/** Mean of the points where the surface cuts the cell's edges, in cells; null when it does not. */
function crossing(grid: Grid, i: number, j: number, k: number): Triple | null {
  let count = 0;
  const sum: [number, number, number] = [0, 0, 0];
  for (const [a, b] of EDGES) {
    const at = grid.corner(i, j, k, a);
    const to = grid.corner(i, j, k, b);
    if (at < 0 === to < 0) continue;
    const share = at / (at - to);
    for (const axis of [0, 1, 2] as const) sum[axis] += mix((a >> axis) & 1, (b >> axis) & 1, share);
    count += 1;
  }
  return count === 0 ? null : [sum[0] / count, sum[1] / count, sum[2] / count];
}

/** Two triangles for each grid edge that the surface cuts, between the four cells around the edge. */
function faces(grid: Grid, cells: Triple, vertexOfCell: ReadonlyMap<number, number>): number[] {
  const indices: number[] = [];
  const vertex = (i: number, j: number, k: number) => vertexOfCell.get(grid.index(i, j, k)) ?? 0;
  const quad = (a: number, b: number, c: number, d: number, flip: boolean) =>
    indices.push(...(flip ? [a, c, b, a, d, c] : [a, b, c, a, c, d]));
  grid.forEach(cells, (i, j, k) => {
    const inside = grid.corner(i, j, k, 0) < 0;
    const cut = (corner: number) => inside !== grid.corner(i, j, k, corner) < 0;
    if (j && k && cut(1))
      quad(vertex(i, j - 1, k - 1), vertex(i, j, k - 1), vertex(i, j, k), vertex(i, j - 1, k), !inside);
    if (i && k && cut(2))
      quad(vertex(i - 1, j, k - 1), vertex(i, j, k - 1), vertex(i, j, k), vertex(i - 1, j, k), inside);
    if (i && j && cut(4))
      quad(vertex(i - 1, j - 1, k), vertex(i, j - 1, k), vertex(i, j, k), vertex(i - 1, j, k), !inside);
  });
  return indices;
}

function normals(distance: Distance, positions: readonly number[], step: number): Float32Array {
  const result = new Float32Array(positions.length);
  for (let v = 0; v < positions.length; v += 3) {
    const [x = 0, y = 0, z = 0] = positions.slice(v, v + 3);
    const slope = [
      distance(x + step, y, z) - distance(x - step, y, z),
      distance(x, y + step, z) - distance(x, y - step, z),
      distance(x, y, z + step) - distance(x, y, z - step),
    ] as const;
    const length = Math.hypot(...slope) || 1;
    result.set(
      slope.map((value) => value / length),
      v,
    );
  }
  return result;
}

function mix(a: number, b: number, share: number): number {
  return a + (b - a) * share;
}
