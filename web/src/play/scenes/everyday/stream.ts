// What runs from the jug into the cup, and drops that splash where motion does not disturb.
import {
  Color,
  CylinderGeometry,
  Group,
  InstancedMesh,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  SphereGeometry,
  Vector3,
} from "three";
import type { Moment } from "../../scene";

const DRINK = new Color("#f4901e");
const DROPS = 6;
const DROP_M = 0.005;
/** The tilted jug's spout, from the hand. */
const SPOUT_M = 0.115;
const SPOUT_BELOW_M = 0.014;
const SPOUT_AHEAD_M = 0.02;
/** The drink in the cup, from where the cup is gripped. */
const SURFACE_BELOW_M = 0.01;

export class Stream {
  readonly group = new Group();
  private readonly jet = new Mesh(new CylinderGeometry(0.006, 0.004, 1, 8), new MeshBasicMaterial({ color: DRINK }));
  private readonly drops = new InstancedMesh(new SphereGeometry(DROP_M, 6, 4), this.jet.material, DROPS);

  constructor(private readonly inward: number) {
    this.drops.frustumCulled = false;
    this.group.add(this.jet, this.drops);
    this.group.visible = false;
  }

  /** Runs from a jug held at `jug` into the cup at `cup`; null = does not run. */
  animate({ now_s, still }: Moment, jug: Vector3 | null, cup: Vector3 | null): void {
    this.group.visible = jug !== null && cup !== null;
    if (!jug || !cup) return;
    const top = new Vector3(jug.x + this.inward * SPOUT_M, jug.y - SPOUT_BELOW_M, jug.z - SPOUT_AHEAD_M);
    const bottom_y = cup.y - SURFACE_BELOW_M;
    const height_m = Math.max(0.01, top.y - bottom_y);
    this.jet.position.set(top.x, bottom_y + height_m / 2, top.z);
    this.jet.scale.set(still ? 1 : 1 + 0.15 * Math.sin(now_s * 23), height_m, 1);
    this.drops.visible = !still;
    for (let i = 0; i < DROPS; i++) this.drops.setMatrixAt(i, drop(i, now_s, top.x, bottom_y, top.z));
    this.drops.instanceMatrix.needsUpdate = true;
  }
}

/** A drop that springs from the surface and falls back, each at its own time. */
function drop(i: number, now_s: number, x: number, y: number, z: number): Matrix4 {
  const age = (now_s * 2.2 + i / DROPS) % 1;
  const around = i * 2.4;
  const out_m = 0.03 * age;
  return new Matrix4().setPosition(
    x + Math.cos(around) * out_m,
    y + 0.14 * age * (1 - age),
    z + Math.sin(around) * out_m,
  );
}
