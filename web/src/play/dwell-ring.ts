// The rings round a place where the hand is to stay: a white one that closes as the hand comes near, and a thick arc
// that fills while it stays. They face the eyes and are never hidden behind hand or thing.
import {
  type BufferGeometry,
  type Camera,
  Color,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  type MeshBasicMaterialParameters,
  RingGeometry,
  type Vector3,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { tinted } from "./paint";

/** The closing ring is wider than the zone by this much per metre between hand and zone. */
const OPENING_PER_M = 2.6;
const WIDEST = 2.3;
const ARC_STEPS = 64;
/** How fast the arc follows its share, which comes in steps of the stream. */
const FOLLOWING_PER_S = 18;
const ABOVE_ALL = 8;

/** In units of the zone's radius: scale the group, or what it is in, by that. */
export class DwellRing {
  readonly group = new Group();
  private readonly closing = edgedRing(0.97, 1.03, 1.075);
  private readonly track = ring(1.07, 1.36, "#1d3a52", 0.85);
  private readonly arc = ring(1.12, 1.31, "#ffd23c", 1, ARC_STEPS);
  private filled = 0;

  constructor() {
    this.group.add(this.track, this.arc, this.closing);
  }

  /** How full the arc is drawn, 0..1. */
  get share(): number {
    return this.filled;
  }

  /** Draws the next `dt_s`: `gap_m` from the hand to the zone's rim (0 inside), `progress` 0..1 of the time to stay. */
  animate(dt_s: number, gap_m: number, progress: number, camera: Camera): void {
    this.filled += (progress - this.filled) * Math.min(1, dt_s * FOLLOWING_PER_S);
    this.group.quaternion.copy(camera.quaternion);
    this.closing.scale.setScalar(Math.min(WIDEST, 1 + gap_m * OPENING_PER_M));
    const holding = this.filled > 0.01;
    this.track.visible = holding;
    this.arc.visible = holding;
    this.arc.geometry.setDrawRange(0, 6 * Math.ceil(ARC_STEPS * this.filled));
  }
}

/** How far `hand` is from entering the zone; as good as far where the hand is not known. */
export function gapTo(hand: Vector3 | null, place: Vector3, radius_m: number): number {
  return hand ? Math.max(0, hand.distanceTo(place) - radius_m) : 1;
}

/** A flat ring; drawn in part it is an arc that runs clockwise from the top. */
function ring(inner: number, outer: number, color: string, opacity: number, steps = 48): Mesh<RingGeometry> {
  const geometry = new RingGeometry(inner, outer, steps, 1, Math.PI / 2, Math.PI * 2);
  geometry.scale(-1, 1, 1);
  return aboveAll(geometry, { color: new Color(color), opacity });
}

/** A white ring with a dark edge: one shape, since every further one costs a slow screen as much again. */
function edgedRing(inner: number, edge: number, outer: number): Mesh {
  const white = tinted(new RingGeometry(inner, edge, 48), "#ffffff");
  const dark = tinted(new RingGeometry(edge, outer, 48), "#1d3a52");
  return aboveAll(mergeGeometries([white, dark]), { vertexColors: true, opacity: 0.9 });
}

function aboveAll<G extends BufferGeometry>(geometry: G, look: MeshBasicMaterialParameters): Mesh<G> {
  const material = new MeshBasicMaterial({ ...look, transparent: true, depthTest: false, side: DoubleSide });
  const mesh = new Mesh(geometry, material);
  mesh.renderOrder = ABOVE_ALL;
  return mesh;
}
