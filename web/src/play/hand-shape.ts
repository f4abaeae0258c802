// The shape of a relaxed hand: rounded bones melted together. Wrist at the origin, fingers along +y, back of the
// hand +z, thumb towards +x on a left hand and −x on a right one. Metres.
import type { BufferGeometry } from "three";
import { type Distance, surfaceNets } from "./surface-nets";

export type Side = "left" | "right";
type Triple = readonly [number, number, number];

interface Bone {
  readonly from: Triple;
  readonly to: Triple;
  readonly radius_m: number;
}

interface Finger {
  readonly root: Triple;
  readonly lengths_m: Triple;
  readonly radius_m: number;
  /** Sideways from straight ahead, towards the thumb positive. */
  readonly splay_rad: number;
  /** Bend of the three joints towards the palm. */
  readonly curl_rad: Triple;
}

const FINGERS: readonly Finger[] = [
  {
    root: [0.029, 0.09, 0],
    lengths_m: [0.043, 0.026, 0.02],
    radius_m: 0.0096,
    splay_rad: 0.15,
    curl_rad: [0.16, 0.3, 0.2],
  },
  {
    root: [0.0095, 0.094, 0.001],
    lengths_m: [0.047, 0.03, 0.021],
    radius_m: 0.0099,
    splay_rad: 0.02,
    curl_rad: [0.2, 0.34, 0.24],
  },
  {
    root: [-0.0105, 0.09, 0],
    lengths_m: [0.043, 0.028, 0.021],
    radius_m: 0.0094,
    splay_rad: -0.11,
    curl_rad: [0.24, 0.38, 0.26],
  },
  {
    root: [-0.029, 0.081, -0.003],
    lengths_m: [0.034, 0.021, 0.018],
    radius_m: 0.0084,
    splay_rad: -0.27,
    curl_rad: [0.28, 0.38, 0.28],
  },
];
const THUMB: readonly Bone[] = [
  { from: [0.02, 0.022, -0.008], to: [0.042, 0.05, -0.017], radius_m: 0.0145 },
  { from: [0.042, 0.05, -0.017], to: [0.055, 0.078, -0.023], radius_m: 0.0112 },
  { from: [0.055, 0.078, -0.023], to: [0.06, 0.1, -0.026], radius_m: 0.0098 },
];
const PALM_CENTRE: Triple = [0, 0.05, -0.001];
const PALM_HALF: Triple = [0.039, 0.046, 0.0125];
const PALM_ROUNDING_M = 0.0122;
/** Half-axes of the wrist, shared with the forearm that ends there. */
export const WRIST_HALF_M = { across: 0.0275, through: 0.0205 } as const;
/** As fine as eyes see at a table's distance; half of all corners on the screen are the hand's. */
const GRID_STEP_M = 0.0065;
/** Enough for what is only seen as a shadow. */
export const ROUGH_STEP_M = 0.009;

/** The surface of one hand, in cells of `step_m`. */
export function handGeometry(side: Side, step_m = GRID_STEP_M): BufferGeometry {
  const thumbwards = side === "left" ? 1 : -1;
  const bones = FINGERS.map(bonesOf);
  const distance: Distance = (mirroredX, y, z) => handDistance(bones, mirroredX * thumbwards, y, z);
  return surfaceNets(distance, [-0.085, -0.05, -0.095], [0.085, 0.205, 0.035], step_m);
}

/** Fingers stay apart from one another (plain minimum) and grow smoothly out of the palm. */
function handDistance(fingers: readonly (readonly Bone[])[], x: number, y: number, z: number): number {
  const palm = melt(palmDistance(x, y, z), wristDistance(x, y, z), 0.022);
  const thumb = chainDistance(THUMB, x, y, z, 0.006);
  const nearest = Math.min(...fingers.map((bones) => chainDistance(bones, x, y, z, 0.003)));
  return melt(melt(palm, thumb, 0.014), nearest, 0.008);
}

/** A finger's three bones, bent towards the palm one after the other. */
function bonesOf(finger: Finger): Bone[] {
  const bones: Bone[] = [];
  let from = finger.root;
  let bend_rad = 0;
  for (const i of [0, 1, 2] as const) {
    bend_rad += finger.curl_rad[i];
    const flat_m = finger.lengths_m[i] * Math.cos(bend_rad);
    const to: Triple = [
      from[0] + flat_m * Math.sin(finger.splay_rad),
      from[1] + flat_m * Math.cos(finger.splay_rad),
      from[2] - finger.lengths_m[i] * Math.sin(bend_rad),
    ];
    bones.push({ from, to, radius_m: finger.radius_m * (1 - 0.09 * i) });
    from = to;
  }
  return bones;
}

function chainDistance(bones: readonly Bone[], x: number, y: number, z: number, softness_m: number): number {
  return bones.reduce((nearest, bone) => melt(nearest, boneDistance(bone, x, y, z), softness_m), 1);
}

function boneDistance({ from, to, radius_m }: Bone, x: number, y: number, z: number): number {
  const along: Triple = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
  const rel: Triple = [x - from[0], y - from[1], z - from[2]];
  const dot = along[0] * rel[0] + along[1] * rel[1] + along[2] * rel[2];
  const share = Math.min(1, Math.max(0, dot / (along[0] ** 2 + along[1] ** 2 + along[2] ** 2)));
  return Math.hypot(rel[0] - share * along[0], rel[1] - share * along[1], rel[2] - share * along[2]) - radius_m;
}

/** A rounded box, narrower at the wrist than at the knuckles. */
function palmDistance(x: number, y: number, z: number): number {
  const taper = 0.8 + 0.2 * Math.min(1, Math.max(0, y / 0.085));
  const dx = Math.abs(x - PALM_CENTRE[0]) - PALM_HALF[0] * taper + PALM_ROUNDING_M;
  const dy = Math.abs(y - PALM_CENTRE[1]) - PALM_HALF[1] + PALM_ROUNDING_M;
  const dz = Math.abs(z - PALM_CENTRE[2]) - PALM_HALF[2] + PALM_ROUNDING_M;
  const outside = Math.hypot(Math.max(dx, 0), Math.max(dy, 0), Math.max(dz, 0));
  return outside + Math.min(Math.max(dx, dy, dz), 0) - PALM_ROUNDING_M;
}

/** A flattened rod about the wrist, scaled so that its distance stays roughly metric. */
function wristDistance(x: number, y: number, z: number): number {
  const beyond = Math.max(0, y - 0.02, -0.012 - y);
  const flattened = z * (WRIST_HALF_M.across / WRIST_HALF_M.through);
  return (Math.hypot(x, beyond, flattened) - WRIST_HALF_M.across) * 0.85;
}

/** Smooth minimum (Quilez's polynomial): joins two shapes with a fillet of about `softness_m`. */
function melt(a: number, b: number, softness_m: number): number {
  const overlap = Math.max(softness_m - Math.abs(a - b), 0) / softness_m;
  return Math.min(a, b) - (overlap * overlap * softness_m) / 4;
}
