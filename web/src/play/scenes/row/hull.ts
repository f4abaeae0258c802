// The boat in which the patient sits: a planked deck, on which shadows fall, and a prow. It stands still before the
// eyes (the water passes), so it belongs to the scenery.
import {
  BufferAttribute,
  BufferGeometry,
  CatmullRomCurve3,
  Color,
  DoubleSide,
  Mesh,
  MeshBasicMaterial,
  TubeGeometry,
  Vector3,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { shade } from "../../paint";
import { TABLE_Y } from "../../table";
import { WATER_Y } from "./water";

const STERN_Z = 0.35;
export const BOW_Z = -2.25;
const HALF_WIDTH_M = 0.43;
const PLANK_M = 0.1;
const SEAM_M = 0.008;
const RIM_M = 0.07;
const RIM_WIDTH_M = 0.035;
const PLANKS = ["#a9764a", "#9c6b42"].map((color) => new Color(color));
const RIM = new Color("#6f3d22");
const SIDE = new Color("#5a2f1b");

export function hull(): Mesh {
  const wood = new MeshBasicMaterial({ vertexColors: true, side: DoubleSide });
  return new Mesh(mergeGeometries([...deck(), ...sides(), prow()]), wood);
}

/** Half the deck's width at a distance ahead: full to the middle, then drawn together in a curve. */
export function halfWidthAt(z: number): number {
  const share = Math.min(1, Math.max(0, (-0.5 - z) / (-0.5 - BOW_Z)));
  return HALF_WIDTH_M * Math.sqrt(1 - share ** 2.2);
}

/** Planks across, so that every seam is a step of distance. */
function deck(): BufferGeometry[] {
  const count = Math.floor((STERN_Z - BOW_Z) / PLANK_M);
  return Array.from({ length: count }, (_, i) => {
    const near = STERN_Z - i * PLANK_M;
    const seam = near - SEAM_M;
    const far = near - PLANK_M;
    return [across(near, seam, SIDE), across(seam, far, PLANKS[i % PLANKS.length] ?? RIM)];
  }).flat();
}

/** From rim to rim between two distances ahead. */
function across(near: number, far: number, color: Color): BufferGeometry {
  const [a, b] = [halfWidthAt(near), halfWidthAt(far)];
  return strip([-a, TABLE_Y, near], [a, TABLE_Y, near], [-b, TABLE_Y, far], [b, TABLE_Y, far], color);
}

/** The raised rim on both sides, and the hull down to the water. */
function sides(): BufferGeometry[] {
  const steps = Array.from({ length: 27 }, (_, i) => STERN_Z - (i * (STERN_Z - BOW_Z)) / 26);
  return steps.slice(1).flatMap((far, i) => {
    const near = steps[i] ?? far;
    return [-1, 1].flatMap((side) => {
      const [a, b] = [side * halfWidthAt(near), side * halfWidthAt(far)];
      const [c, d] = [a + side * RIM_WIDTH_M, b + side * RIM_WIDTH_M];
      const top = TABLE_Y + RIM_M;
      return [
        strip([a, TABLE_Y, near], [a, top, near], [b, TABLE_Y, far], [b, top, far], SIDE),
        strip([a, top, near], [c, top, near], [b, top, far], [d, top, far], RIM),
        strip([c, top, near], [c, WATER_Y, near], [d, top, far], [d, WATER_Y, far], SIDE),
      ];
    });
  });
}

type Corner = readonly [number, number, number];

function strip(a: Corner, b: Corner, c: Corner, d: Corner, color: Color): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array([a, b, c, b, d, c].flat()), 3));
  const colors = Array.from({ length: 6 }, () => color.toArray()).flat();
  geometry.setAttribute("color", new BufferAttribute(new Float32Array(colors), 3));
  return geometry;
}

function prow(): BufferGeometry {
  const curve = new CatmullRomCurve3([
    new Vector3(0, WATER_Y, BOW_Z + 0.12),
    new Vector3(0, TABLE_Y + 0.06, BOW_Z - 0.06),
    new Vector3(0, TABLE_Y + 0.26, BOW_Z - 0.2),
    new Vector3(0, TABLE_Y + 0.44, BOW_Z - 0.14),
  ]);
  const geometry = shade(new TubeGeometry(curve, 14, 0.04, 8).toNonIndexed(), RIM);
  geometry.deleteAttribute("normal");
  return geometry;
}
