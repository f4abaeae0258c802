// A supple tube of changing, flattened cross-section along an arm: skin of the forearm, cloth of the sleeve.
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Quaternion, type Vector3 } from "three";
import { type ArmPose, stationAt } from "./limb-line";

/** One ring: where along the arm (0 shoulder, 1 elbow, 2 wrist) and its half-axes in metres. */
export interface Ring {
  readonly s: number;
  readonly across_m: number;
  readonly through_m: number;
}

const SEGMENTS = 22;
const ANGLES = Array.from({ length: SEGMENTS }, (_, i) => (2 * Math.PI * i) / SEGMENTS);
const CIRCLE = ANGLES.map((angle) => [Math.cos(angle), Math.sin(angle)] as const);

export class LimbTube {
  readonly geometry = new BufferGeometry();
  private readonly positions: BufferAttribute;

  constructor(private readonly rings: readonly Ring[]) {
    this.positions = new BufferAttribute(new Float32Array(rings.length * SEGMENTS * 3), 3).setUsage(DynamicDrawUsage);
    this.geometry.setAttribute("position", this.positions);
    this.geometry.setIndex(wall(rings.length));
  }

  /** Bends the tube to a pose; `across` and `back` are the forearm's thumb-wards and back-wards directions. */
  bend(pose: ArmPose, forearm: Vector3, across: Vector3, back: Vector3): void {
    this.rings.forEach((ring, row) => {
      const { position, tangent } = stationAt(pose, ring.s);
      // The least rotation carries the cross-section round the elbow without a twist.
      const turn = new Quaternion().setFromUnitVectors(forearm, tangent);
      const x = across.clone().applyQuaternion(turn).multiplyScalar(ring.across_m);
      const z = back.clone().applyQuaternion(turn).multiplyScalar(ring.through_m);
      CIRCLE.forEach(([cos, sin], column) => {
        const i = row * SEGMENTS + column;
        this.positions.setXYZ(
          i,
          position.x + cos * x.x + sin * z.x,
          position.y + cos * x.y + sin * z.y,
          position.z + cos * x.z + sin * z.z,
        );
      });
    });
    this.positions.needsUpdate = true;
    this.geometry.computeVertexNormals();
  }
}

/** Triangles between neighbouring rings, closed round the circle. */
function wall(rings: number): number[] {
  const indices: number[] = [];
  for (let row = 0; row + 1 < rings; row++) {
    for (let column = 0; column < SEGMENTS; column++) {
      const a = row * SEGMENTS + column;
      const b = row * SEGMENTS + ((column + 1) % SEGMENTS);
      indices.push(a, a + SEGMENTS, b, b, a + SEGMENTS, b + SEGMENTS);
    }
  }
  return indices;
}

/** Rings every `step` along a profile of (s, half-width, half-thickness) points, smoothly between them. */
export function profile(points: readonly (readonly [number, number, number])[], step = 0.06): Ring[] {
  const rings: Ring[] = [];
  points.slice(1).forEach((to, i) => {
    const from = points[i] ?? to;
    const count = Math.max(1, Math.round(Math.abs(to[0] - from[0]) / step));
    for (let k = 0; k < count; k++) rings.push(between(from, to, k / count));
  });
  const last = points.at(-1);
  return last ? [...rings, between(last, last, 0)] : rings;
}

function between(from: readonly [number, number, number], to: readonly [number, number, number], share: number): Ring {
  const eased = share * share * (3 - 2 * share);
  return {
    s: from[0] + (to[0] - from[0]) * share,
    across_m: from[1] + (to[1] - from[1]) * eased,
    through_m: from[2] + (to[2] - from[2]) * eased,
  };
}
