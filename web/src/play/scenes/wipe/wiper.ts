// The cloth under the hand, on the glass, and while the hand is too far from it a ring that closes as it comes near.
import {
  Color,
  CylinderGeometry,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  RingGeometry,
  type Vector3,
} from "three";
import type { ThingView } from "../../changes";
import { BENEATH } from "./glass";

const CLOTH_THICK_M = 0.012;
const LIFT_M = 0.004;
/** At this distance from the glass the ring is three times as wide. */
const FAR_M = 0.3;
const OPENS = 2;

export class Wiper {
  /** In the glass's own frame: x right, y up the glass, z towards the eyes. */
  readonly group = new Group();
  private readonly cloth: Mesh;
  private readonly ring: Group;

  constructor() {
    this.cloth = new Mesh(
      new CylinderGeometry(0.94, 1, CLOTH_THICK_M, 28).rotateX(Math.PI / 2),
      new MeshLambertMaterial({ color: new Color("#f4c64a"), emissive: new Color("#4a3608"), depthWrite: false }),
    );
    this.ring = new Group();
    this.ring.add(ring(0.96, 1.04, "#ffffff"), ring(1.04, 1.1, "#12304a"));
    this.cloth.position.z = LIFT_M + CLOTH_THICK_M / 2;
    this.cloth.renderOrder = BENEATH + 2;
    this.group.add(this.cloth, this.ring);
    this.group.visible = false;
  }

  /** `hand` in the glass's frame: its z is how far it is before the glass. */
  animate(view: ThingView | null, hand: Vector3 | null): void {
    this.group.visible = view !== null && hand !== null;
    if (!view || !hand) return;
    const away = Math.min(1, Math.abs(hand.z) / FAR_M);
    this.group.position.set(hand.x, hand.y, 0);
    this.cloth.visible = view.state === "on";
    this.ring.visible = view.state !== "on";
    this.cloth.scale.set(view.radius_m, view.radius_m, 1);
    this.ring.scale.setScalar(view.radius_m * (1 + OPENS * away));
  }
}

function ring(inner: number, outer: number, color: string): Mesh {
  const paint = new MeshBasicMaterial({
    color: new Color(color),
    transparent: true,
    opacity: 0.9,
    depthTest: false,
    side: DoubleSide,
  });
  const mesh = new Mesh(new RingGeometry(inner, outer, 40), paint);
  mesh.renderOrder = 7;
  return mesh;
}
