// The place where a butterfly comes down: a blossom of light that opens until it is there, and a ring that closes.
import {
  Color,
  DoubleSide,
  Group,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  Shape,
  ShapeGeometry,
  Vector3,
} from "three";
import type { ThingView } from "../../changes";
import { DwellRing, gapTo } from "../../dwell-ring";
import type { Moment } from "../../scene";

const PETALS = 5;
/** The ring is this much wider than the zone when the place is announced, in metres of `DwellRing`'s gap. */
const OPENS_M = 0.5;

export class Landing {
  readonly group = new Group();
  private readonly rings = new DwellRing();
  private readonly petals: InstancedMesh;
  private readonly light: MeshBasicMaterial;
  private readonly facing = new Group();
  private share: number;

  constructor(private view: ThingView) {
    this.share = view.progress;
    this.light = new MeshBasicMaterial({ color: new Color("#ffe3ee"), side: DoubleSide, transparent: true });
    this.light.depthTest = false;
    this.petals = new InstancedMesh(petal(), this.light, PETALS);
    this.petals.renderOrder = 7;
    this.petals.frustumCulled = false;
    this.facing.add(this.petals);
    this.group.add(this.facing, this.rings.group);
    this.group.scale.setScalar(view.radius_m);
    this.group.position.set(...view.position);
  }

  show(view: ThingView): void {
    this.view = view;
  }

  animate({ dt_s, hand, camera, still, now_s }: Moment): void {
    const { radius_m } = this.view;
    this.share += (this.view.progress - this.share) * Math.min(1, 14 * dt_s);
    const inside = gapTo(hand, new Vector3(...this.view.position), radius_m) === 0;
    // The arc shows how soon it comes once the hand waits there.
    this.rings.animate(dt_s, OPENS_M * (1 - this.share), inside ? Math.max(0.02, this.share) : 0, camera);
    this.facing.quaternion.copy(camera.quaternion);
    const pulse = still || this.view.state !== "here" ? 0 : 0.08 * Math.sin(now_s * 7);
    this.open(0.35 + 0.65 * this.share + pulse);
    this.light.opacity = inside ? 0.4 : 0.62;
  }

  private open(share: number): void {
    for (let i = 0; i < PETALS; i++) {
      const turned = new Matrix4().makeRotationZ((i / PETALS) * 2 * Math.PI);
      this.petals.setMatrixAt(i, turned.multiply(new Matrix4().makeScale(share, share, 1)));
    }
    this.petals.instanceMatrix.needsUpdate = true;
  }
}

/** A cherry petal from the middle to the rim, notched at its end. */
function petal(): ShapeGeometry {
  const shape = new Shape();
  shape.moveTo(0, 0.14);
  shape.bezierCurveTo(0.3, 0.3, 0.52, 0.62, 0.2, 0.96);
  shape.lineTo(0, 0.84);
  shape.lineTo(-0.2, 0.96);
  shape.bezierCurveTo(-0.52, 0.62, -0.3, 0.3, 0, 0.14);
  return new ShapeGeometry(shape, 6);
}
