// What makes depth readable: a plumb line and a ring on the table under hand and target, and a dotted way between.
import {
  Color,
  CylinderGeometry,
  DoubleSide,
  Group,
  InstancedMesh,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  RingGeometry,
  SphereGeometry,
  type Vector3,
} from "three";
import { TABLE_Y } from "./table";

const LIFT_M = 0.003;
const DOTS = 7;
const DOT_M = 0.006;
/** Nearer than this the way is plain and the dots go. */
const SHORTEST_WAY_M = 0.1;
/** The dots begin and end off the hand and the fruit. */
const CLEAR_M = 0.07;

/** A plumb line with a ring where it meets the table. */
class Plumb {
  readonly group = new Group();
  private readonly line: Mesh;
  private readonly foot: Mesh;

  constructor(color: string, radius_m: number) {
    const paint = (opacity: number) =>
      new MeshBasicMaterial({
        color: new Color(color),
        transparent: true,
        opacity,
        side: DoubleSide,
        depthWrite: false,
      });
    this.line = new Mesh(new CylinderGeometry(0.0022, 0.0022, 1, 6), paint(0.75));
    this.foot = new Mesh(new RingGeometry(radius_m * 0.76, radius_m, 32), paint(0.95));
    this.foot.rotation.x = -Math.PI / 2;
    this.group.add(this.line, this.foot);
  }

  hang(from: Vector3): void {
    const length_m = Math.max(0.001, from.y - TABLE_Y);
    this.line.position.set(from.x, TABLE_Y + length_m / 2, from.z);
    this.line.scale.y = length_m;
    this.foot.position.set(from.x, TABLE_Y + LIFT_M, from.z);
  }
}

export class Guide {
  readonly group = new Group();
  private readonly targetPlumb = new Plumb("#ffb347", 0.06);
  private readonly handPlumb = new Plumb("#d4efff", 0.04);
  private readonly dots: InstancedMesh;

  constructor() {
    const paint = new MeshBasicMaterial({ color: new Color("#ffffff"), transparent: true, opacity: 0.9 });
    this.dots = new InstancedMesh(new SphereGeometry(1, 8, 5), paint, DOTS);
    this.dots.frustumCulled = false;
    this.group.add(this.targetPlumb.group, this.handPlumb.group, this.dots);
  }

  /** Shows the way from `hand` to `target`; either may be missing. */
  lead(hand: Vector3 | null, target: Vector3 | null): void {
    this.handPlumb.group.visible = hand !== null && target !== null;
    this.targetPlumb.group.visible = target !== null;
    if (hand) this.handPlumb.hang(hand);
    if (target) this.targetPlumb.hang(target);
    const way_m = hand && target ? hand.distanceTo(target) : 0;
    this.dots.visible = way_m > SHORTEST_WAY_M + 2 * CLEAR_M;
    if (hand && target && this.dots.visible) this.strew(hand, target, CLEAR_M / way_m);
  }

  private strew(hand: Vector3, target: Vector3, clear: number): void {
    for (let i = 0; i < DOTS; i++) {
      const share = clear + ((1 - 2 * clear) * i) / (DOTS - 1);
      const at = hand.clone().lerp(target, share);
      const size_m = DOT_M * (0.6 + 0.4 * share);
      this.dots.setMatrixAt(i, new Matrix4().makeScale(size_m, size_m, size_m).setPosition(at));
    }
    this.dots.instanceMatrix.needsUpdate = true;
  }
}
