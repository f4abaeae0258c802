// The shape of a butterfly's right wings, flat, with dark rims and spots: the pattern shows where colours do not.
import { type BufferGeometry, Color, Shape, ShapeGeometry, Vector2, type Vector3 } from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { paint } from "../../paint";

type Curve = readonly (readonly [number, number, number, number, number, number])[];

/** Outlines as Bézier curves in units of the wing's length: outwards, ahead. */
const FOREWING = {
  from: [0.03, 0.2],
  curves: [
    [0.3, 0.75, 0.8, 0.98, 1, 0.84],
    [1.08, 0.6, 0.92, 0.24, 0.78, 0.1],
    [0.5, -0.02, 0.2, -0.02, 0.03, 0],
  ],
} as const satisfies Outline;
const HINDWING = {
  from: [0.03, 0.06],
  curves: [
    [0.35, 0.1, 0.78, 0.12, 0.84, -0.15],
    [0.86, -0.5, 0.62, -0.84, 0.46, -0.8],
    [0.25, -0.76, 0.06, -0.4, 0.03, -0.1],
  ],
} as const satisfies Outline;
const SPOTS = [
  [0.86, 0.62, 0.05],
  [0.82, 0.44, 0.045],
  [0.74, 0.28, 0.04],
  [0.66, -0.32, 0.05],
  [0.56, -0.55, 0.045],
] as const;
const RIM = new Color("#1a1420");
/** Takes the butterfly's own colour. */
const FIELD = new Color("#ffffff");
const STEPS = 7;
const FIELD_SHARE = 0.8;

interface Outline {
  readonly from: readonly [number, number];
  readonly curves: Curve;
}

/** Both right wings in the plane y = 0: x outwards, −z ahead; one colour of a material tints all but the rims. */
export function wingGeometry(): BufferGeometry {
  const layers = [FOREWING, HINDWING].flatMap((outline) => {
    const points = pointsOf(outline);
    return [layer(points, RIM, 0), layer(shrunk(points), FIELD, 0.004)];
  });
  const spots = SPOTS.map(([x, ahead, radius]) => layer(disc(x, ahead, radius), FIELD, 0.008));
  return mergeGeometries([...layers, ...spots]);
}

function pointsOf({ from, curves }: Outline): Vector2[] {
  const shape = new Shape();
  shape.moveTo(...from);
  for (const curve of curves) shape.bezierCurveTo(...curve);
  return shape.getPoints(STEPS);
}

/** What the rim leaves free. */
function shrunk(points: readonly Vector2[]): Vector2[] {
  const middle = points.reduce((sum, point) => sum.add(point), new Vector2()).divideScalar(points.length);
  return points.map((point) => point.clone().sub(middle).multiplyScalar(FIELD_SHARE).add(middle));
}

function disc(x: number, ahead: number, radius: number): Vector2[] {
  return Array.from({ length: 8 }, (_, i) => {
    const turn = (i / 8) * 2 * Math.PI;
    return new Vector2(x + radius * Math.cos(turn), ahead + radius * Math.sin(turn));
  });
}

function layer(points: Vector2[], color: Color, above: number): BufferGeometry {
  const geometry = new ShapeGeometry(new Shape(points));
  geometry.rotateX(-Math.PI / 2);
  geometry.translate(0, above, 0);
  return paint(geometry, (_: Vector3) => color);
}
