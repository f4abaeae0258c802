// Trees, a hedge and flowers beyond the table.
import { type BufferGeometry, Color, CylinderGeometry, IcosahedronGeometry, Mesh, MeshBasicMaterial } from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { shade } from "../../paint";

type Tree = readonly [x: number, z: number, height: number, color: string];
const TREES: readonly Tree[] = [
  [-11, -22, 4.2, "#7fb069"],
  [-15.5, -20, 5, "#6fa25c"],
  [-5.5, -25, 3.4, "#8ab877"],
  [13, -23, 4.6, "#74a862"],
  [18, -21, 4.8, "#83b36c"],
  [6.8, -26, 3.6, "#8dbb7c"],
];
/** Middle and radius of a crown's balls, in units of the tree's height. */
const CROWN = [
  [0, 0.62, 0.3],
  [-0.17, 0.5, 0.21],
  [0.18, 0.53, 0.22],
  [0.03, 0.82, 0.2],
] as const;
const TRUNK = new Color("#8a6a4c");
const BUSH = new Color("#6fa85c");
const BUSHES = 33;
const FLOWERS = ["#f6c945", "#fbf8f1", "#e0728f", "#b58ad6"] as const;
const FLOWER_COUNT = 120;
/** Steps that never fall into a visible pattern (golden ratio and √2 less their whole parts). */
const SPREAD_X = 0.618;
const SPREAD_Z = 0.414;

/** All plants on a lawn at height `lawnY`, as one mesh: one draw call. */
export function plants(lawnY: number): Mesh {
  const geometry = mergeGeometries([...TREES.flatMap(tree), ...hedge(), ...flowers()]);
  geometry.translate(0, lawnY, 0);
  return new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true }));
}

function tree([x, z, height, color]: Tree): BufferGeometry[] {
  const trunk = new CylinderGeometry(height * 0.03, height * 0.05, height * 0.5, 7).toNonIndexed();
  trunk.translate(x, height * 0.25, z);
  const crown = CROWN.map(([dx, dy, radius]) =>
    ball(x + dx * height, dy * height, z + dx * 0.3 * height, radius * height, new Color(color)),
  );
  return [shade(trunk, TRUNK), ...crown];
}

function hedge(): BufferGeometry[] {
  return Array.from({ length: BUSHES }, (_, i) => {
    const x = (i - (BUSHES - 1) / 2) * 0.95;
    const color = BUSH.clone().offsetHSL(0, 0, 0.025 * Math.sin(i * 3.1));
    return ball(x, 0.2, -11 - 0.4 * Math.cos(i * 1.7), 0.66 + 0.12 * Math.sin(i * 2.3), color);
  });
}

function flowers(): BufferGeometry[] {
  return Array.from({ length: FLOWER_COUNT }, (_, i) => {
    const x = ((i * SPREAD_X) % 1) * 22 - 11;
    const z = -7.6 - ((i * SPREAD_Z) % 1) * 2.4;
    const size = 0.065 + 0.02 * Math.sin(i * 1.3);
    return ball(x, 0.12 + 0.06 * Math.sin(i), z, size, new Color(FLOWERS[i % FLOWERS.length]), 0);
  });
}

function ball(x: number, y: number, z: number, radius: number, color: Color, detail = 1): BufferGeometry {
  const geometry = new IcosahedronGeometry(radius, detail);
  geometry.translate(x, y, z);
  return shade(geometry, color);
}
