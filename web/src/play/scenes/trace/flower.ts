// The water lily at a path's end, and round it an arc that says how much of the time is left.
import {
  type BufferGeometry,
  Color,
  DoubleSide,
  GreaterDepth,
  Group,
  Mesh,
  MeshBasicMaterial,
  MeshPhongMaterial,
  RingGeometry,
  SphereGeometry,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import type { ThingView } from "../../changes";
import type { Moment } from "../../scene";

const PETAL_M = 0.05;
const OUTER = 8;
const INNER = 6;
const ARC_STEPS = 48;
const BELOW_M = 0.02;
const ABOVE_ALL = 6;
const OPENING_PER_S = 1.6;

export class Flower {
  readonly group = new Group();
  private readonly blossom = new Group();
  private readonly facing = new Group();
  private readonly arc = ring(1.14, 1.3, "#ffffff", 1, ABOVE_ALL + 1);
  private open = 0;

  constructor(view: ThingView) {
    this.blossom.add(...petals(OUTER, 0.5, "#f48fb1", 0), ...petals(INNER, 1, "#ffe3ec", 0.5), heart());
    this.blossom.position.y = -BELOW_M;
    this.facing.add(ring(1.08, 1.36, "#1b2740", 0.7, ABOVE_ALL), this.arc);
    this.facing.scale.setScalar(view.radius_m);
    this.group.add(this.blossom, this.facing);
    this.group.position.set(...view.position);
  }

  animate({ dt_s, now_s, camera, still }: Moment, view: ThingView): void {
    this.open = still ? 1 : Math.min(1, this.open + dt_s * OPENING_PER_S);
    this.blossom.scale.setScalar(Math.max(1e-3, this.open * (2 - this.open)));
    if (!still) this.blossom.rotation.y = 0.3 * Math.sin(now_s * 0.6);
    this.facing.quaternion.copy(camera.quaternion);
    this.facing.visible = view.progress < 1;
    this.arc.geometry.setDrawRange(0, 6 * Math.ceil(ARC_STEPS * view.progress));
  }
}

/** Petals in a circle, raised by `lift_rad` and turned by a share of the step between two; and what shows of them
 * through an arm before them. */
function petals(count: number, lift_rad: number, color: string, turn: number): Mesh[] {
  const shape = mergeGeometries(
    Array.from({ length: count }, (_, i) => petal(lift_rad, ((i + turn) * 2 * Math.PI) / count)),
  );
  const tint = new Color(color);
  const paint = new MeshPhongMaterial({ color: tint, emissive: tint.clone().multiplyScalar(0.25) });
  const through = new MeshBasicMaterial({ color: tint, transparent: true, opacity: 0.45, depthWrite: false });
  through.depthFunc = GreaterDepth;
  return [new Mesh(shape, paint), new Mesh(shape, through)];
}

function petal(lift_rad: number, turn_rad: number): BufferGeometry {
  const shape = new SphereGeometry(PETAL_M / 2, 8, 6);
  shape.scale(1, 0.22, 0.46);
  shape.translate(PETAL_M / 2, 0, 0);
  return shape.rotateZ(lift_rad).rotateY(turn_rad);
}

function heart(): Mesh {
  const mesh = new Mesh(new SphereGeometry(0.011, 10, 8), new MeshBasicMaterial({ color: new Color("#ffd23c") }));
  mesh.position.y = 0.012;
  return mesh;
}

/** A flat ring that is never hidden; its arc runs clockwise from the top. */
function ring(inner: number, outer: number, color: string, opacity: number, order: number): Mesh<RingGeometry> {
  const geometry = new RingGeometry(inner, outer, ARC_STEPS, 1, Math.PI / 2, 2 * Math.PI);
  geometry.scale(-1, 1, 1);
  const paint = new MeshBasicMaterial({ color: new Color(color), transparent: true, opacity, depthTest: false });
  paint.side = DoubleSide;
  const mesh = new Mesh(geometry, paint);
  mesh.renderOrder = order;
  return mesh;
}
