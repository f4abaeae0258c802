// A body as lines on a flat picture: seen from behind, so that its left is on the left.
import type { Side } from "../../api/types";

export type Joint3 = readonly [number, number, number] | null;
/** Ends of a line in metres: x to the body's right, y downwards as in SVG. */
export type Line = readonly [number, number, number, number];

/** Where the picture's middle is and which way its right lies, on the floor. */
export interface Frame {
  origin: readonly [number, number, number];
  right: readonly [number, number];
}

/** Places of Kinect's joints in a list of 25. */
const SPINE_SHOULDER = 20;
const SHOULDER: Record<Side, number> = { left: 4, right: 8 };
/** Spine with head and hips; legs do not matter here. */
const TRUNK: readonly (readonly [number, number])[] = [
  [0, 1],
  [1, 20],
  [20, 2],
  [2, 3],
  [20, 4],
  [20, 8],
  [0, 12],
  [0, 16],
];
const ARM: Record<Side, readonly (readonly [number, number])[]> = {
  left: [
    [4, 5],
    [5, 6],
    [6, 7],
  ],
  right: [
    [8, 9],
    [9, 10],
    [10, 11],
  ],
};

/** The frame of a body; null while its shoulders are not known. */
export function frameOf(joints: readonly Joint3[]): Frame | null {
  const [left, right, origin] = [joints[SHOULDER.left], joints[SHOULDER.right], joints[SPINE_SHOULDER]];
  if (!left || !right || !origin) return null;
  const across = [right[0] - left[0], right[2] - left[2]] as const;
  const width = Math.hypot(...across);
  return width > 0 ? { origin, right: [across[0] / width, across[1] / width] } : null;
}

export function trunkLines(joints: readonly Joint3[], frame: Frame): Line[] {
  return linesOf(joints, TRUNK, frame);
}

export function armLines(joints: readonly Joint3[], side: Side, frame: Frame): Line[] {
  return linesOf(joints, ARM[side], frame);
}

function linesOf(joints: readonly Joint3[], bones: readonly (readonly [number, number])[], frame: Frame): Line[] {
  return bones.flatMap(([from, to]) => {
    const [a, b] = [joints[from], joints[to]];
    return a && b ? [[...flat(a, frame), ...flat(b, frame)] as const] : [];
  });
}

function flat([x, y, z]: readonly [number, number, number], { origin, right }: Frame): [number, number] {
  return [(x - origin[0]) * right[0] + (z - origin[2]) * right[1], origin[1] - y];
}
