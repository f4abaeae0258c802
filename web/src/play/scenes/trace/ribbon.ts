// The path: a pale thread with arrow heads that say which way, a thick golden part that is done, a veil as wide as the
// hand may stray, and its shadow on the planks. Thread and arrows show faintly through an arm before them.
import {
  BackSide,
  CatmullRomCurve3,
  Color,
  ConeGeometry,
  GreaterDepth,
  Group,
  InstancedMesh,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  Quaternion,
  TubeGeometry,
  Vector3,
} from "three";
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
const AHEAD = new Vector3(0, 1, 0);

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
    const veil = new Mesh(tube(radius_m, VEIL_AROUND), this.paint("#ffe9b0", 0.15));
    veil.material.side = BackSide;
    veil.material.depthWrite = false;
    veil.renderOrder = -1;
    const thread = new Mesh(tube(THREAD_M), this.paint("#fffdf0", 1));
    const through = new Mesh(thread.geometry, this.paint("#fffdf0", 0.4));
    through.material.depthFunc = GreaterDepth;
    through.material.depthWrite = false;
    this.done = new Mesh(tube(DONE_M), this.paint("#ffc93c", 1));
    const shadow = new Mesh(tube(SHADOW_M), this.paint("#050a12", 0.5));
    shadow.material.depthWrite = false;
    shadow.scale.y = 1e-4;
    shadow.position.y = TABLE_Y + LIFT_M;
    shadow.renderOrder = -2;
    this.group.add(veil, thread, through, this.done, shadow, this.arrows(curve, length_m));
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

  private paint(color: string, opacity: number): MeshBasicMaterial {
    const paint = new MeshBasicMaterial({ color: new Color(color), transparent: true, opacity: 0 });
    this.paints.push({ paint, opacity });
    return paint;
  }

  /** Small heads along the thread that point to its end. */
  private arrows(curve: CatmullRomCurve3, length_m: number): InstancedMesh {
    const count = Math.max(1, Math.floor(length_m / ARROWS_EVERY_M));
    const heads = new InstancedMesh(new ConeGeometry(ARROW_M, 2.4 * ARROW_M, 8), this.paint("#fffdf0", 1), count);
    heads.frustumCulled = false;
    for (let i = 0; i < count; i++) {
      const share = (i + 0.5) / count;
      const turn = new Quaternion().setFromUnitVectors(AHEAD, curve.getTangentAt(share));
      heads.setMatrixAt(i, new Matrix4().makeRotationFromQuaternion(turn).setPosition(curve.getPointAt(share)));
    }
    return heads;
  }
}
