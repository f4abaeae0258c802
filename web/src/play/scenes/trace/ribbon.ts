// The path: a pale thread with arrow heads that say which way, a thick golden part that is done, a veil as wide as the
// hand may stray, and its shadow on the planks. Thread and arrows show faintly through an arm before them.
import {
  BackSide,
  type BufferGeometry,
  CatmullRomCurve3,
  Color,
  ConeGeometry,
  GreaterDepth,
  Group,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  Quaternion,
  TubeGeometry,
  Vector3,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { TABLE_Y } from "../../table";

const THREAD_M = 0.0045;
const DONE_M = 0.013;
const SHADOW_M = 0.008;
const AROUND = 7;
const VEIL_AROUND = 20;
const PIECE_M = 0.012;
const ARROWS_EVERY_M = 0.045;
const ARROW_M = 0.011;
const FADE_S = 0.7;
const APPEAR_S = 0.5;
const LIFT_M = 0.0035;
const PALE = "#fffdf0";
/** Where a cone points. */
const UPWARDS = new Vector3(0, 1, 0);

export class Ribbon {
  readonly group = new Group();
  private readonly done: Mesh<TubeGeometry, MeshBasicMaterial>;
  private readonly paints: { readonly paint: MeshBasicMaterial; readonly opacity: number }[] = [];
  private readonly pieces: number;
  private there = 0;
  private leaving = false;

  constructor(points: Vector3[], radius_m: number) {
    const curve = new CatmullRomCurve3(points);
    const length_m = curve.getLength();
    this.pieces = Math.max(8, Math.round(length_m / PIECE_M));
    const tube = (thickness_m: number, around = AROUND) => new TubeGeometry(curve, this.pieces, thickness_m, around);
    const thread = tube(THREAD_M);
    this.done = this.mesh(tube(DONE_M), "#ffc93c", 1);
    this.mesh(thread, PALE, 1);
    this.mesh(arrowHeads(curve, length_m), PALE, 1);
    seeThrough(this.mesh(thread, PALE, 0.4), 0).material.depthFunc = GreaterDepth;
    seeThrough(this.mesh(tube(radius_m, VEIL_AROUND), "#ffe9b0", 0.15), -1).material.side = BackSide;
    const shadow = seeThrough(this.mesh(tube(SHADOW_M), "#050a12", 0.5), -2);
    shadow.scale.y = 1e-4;
    shadow.position.y = TABLE_Y + LIFT_M;
  }

  /** True once a path that was taken away has faded. */
  get gone(): boolean {
    return this.leaving && this.there <= 0;
  }

  leave(): void {
    this.leaving = true;
  }

  /** Draws the next `dt_s` with `share` (0..1) of the path done. */
  animate({ dt_s, still }: { readonly dt_s: number; readonly still: boolean }, share: number): void {
    const step = this.leaving ? -dt_s / FADE_S : dt_s / APPEAR_S;
    this.there = still && !this.leaving ? 1 : Math.max(0, Math.min(1, this.there + step));
    for (const { paint, opacity } of this.paints) paint.opacity = opacity * this.there;
    this.done.geometry.setDrawRange(0, Math.round(share * this.pieces) * AROUND * 6);
  }

  private mesh<G extends BufferGeometry>(shape: G, color: string, opacity: number): Mesh<G, MeshBasicMaterial> {
    const paint = new MeshBasicMaterial({ color: new Color(color), transparent: true, opacity: 0 });
    this.paints.push({ paint, opacity });
    const mesh = new Mesh(shape, paint);
    this.group.add(mesh);
    return mesh;
  }
}

/** What never hides anything, drawn before or after the rest as `order` says. */
function seeThrough(mesh: Mesh<BufferGeometry, MeshBasicMaterial>, order: number): typeof mesh {
  mesh.material.depthWrite = false;
  mesh.renderOrder = order;
  return mesh;
}

/** Small heads along the thread that point to its end. */
function arrowHeads(curve: CatmullRomCurve3, length_m: number): BufferGeometry {
  const count = Math.max(1, Math.floor(length_m / ARROWS_EVERY_M));
  const heads = Array.from({ length: count }, (_, i) => {
    const share = (i + 0.5) / count;
    const turn = new Quaternion().setFromUnitVectors(UPWARDS, curve.getTangentAt(share));
    const place = new Matrix4().makeRotationFromQuaternion(turn).setPosition(curve.getPointAt(share));
    return new ConeGeometry(ARROW_M, 2.4 * ARROW_M, 8).applyMatrix4(place);
  });
  return mergeGeometries(heads);
}
