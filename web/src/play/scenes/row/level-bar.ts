// How alike the hands are: a bar on the deck from beneath one hand to beneath the other. It lies square across the boat
// and carries a diamond while they are even; an arrow stands by the hand that hangs back.
import {
  CircleGeometry,
  Color,
  Group,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  Shape,
  ShapeGeometry,
  type Vector3,
} from "three";
import { TABLE_Y } from "../../table";

const LIFT_M = 0.006;
const WIDTH_M = 0.016;
const EVEN = new Color("#fff3b0");
const UNEVEN = new Color("#ffb347");

export class LevelBar {
  readonly group = new Group();
  private readonly paint = new MeshBasicMaterial({ color: EVEN, transparent: true, opacity: 0.95, depthWrite: false });
  private readonly bar = new Mesh(new PlaneGeometry(1, 1).rotateX(-Math.PI / 2), this.paint);
  readonly diamond = new Mesh(new CircleGeometry(0.042, 4).rotateX(-Math.PI / 2), this.paint);
  readonly arrow = new Mesh(arrowShape(), this.paint);

  constructor() {
    for (const part of [this.bar, this.diamond, this.arrow]) part.renderOrder = -1;
    this.group.add(this.bar, this.diamond, this.arrow);
  }

  /** `state` as in the rules' boat; `ahead` says whether the hands are on their way ahead. */
  show(hand: Vector3 | null, healthy: Vector3 | null, state: string, ahead: boolean): void {
    this.group.visible = hand !== null && healthy !== null && state !== "unseen";
    if (!hand || !healthy) return;
    const [left, right] = hand.x < healthy.x ? [hand, healthy] : [healthy, hand];
    this.lay(left, right);
    const even = state === "even";
    this.paint.color.copy(even ? EVEN : UNEVEN);
    this.diamond.visible = even;
    this.arrow.visible = !even;
    const behind = state === "left" ? left : right;
    this.arrow.position.set(behind.x, TABLE_Y + LIFT_M, behind.z + (ahead ? -0.09 : 0.09));
    this.arrow.rotation.y = ahead ? 0 : Math.PI;
  }

  private lay(left: Vector3, right: Vector3): void {
    const [dx, dz] = [right.x - left.x, right.z - left.z];
    this.bar.position.set((left.x + right.x) / 2, TABLE_Y + LIFT_M, (left.z + right.z) / 2);
    this.bar.rotation.y = -Math.atan2(dz, dx);
    this.bar.scale.set(Math.hypot(dx, dz), 1, WIDTH_M);
    this.diamond.position.copy(this.bar.position);
  }
}

/** Points ahead. */
function arrowShape(): ShapeGeometry {
  const shape = new Shape();
  shape.moveTo(0, 0.07);
  shape.lineTo(0.055, 0);
  shape.lineTo(0.02, 0);
  shape.lineTo(0.02, -0.05);
  shape.lineTo(-0.02, -0.05);
  shape.lineTo(-0.02, 0);
  shape.lineTo(-0.055, 0);
  const geometry = new ShapeGeometry(shape);
  geometry.rotateX(-Math.PI / 2);
  return geometry;
}
