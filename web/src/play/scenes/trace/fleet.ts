// The lanterns brought home: each finished path sets one more afloat, until the lake is full of lights.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  CylinderGeometry,
  Group,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  PlaneGeometry,
  Points,
  PointsMaterial,
  type Quaternion,
  Vector3,
} from "three";
import type { Moment } from "../../scene";
import { glowTexture } from "../../textures";
import { WATER_Y } from "./lake";

export const MOST = 48;
const GLIDE_S = 1.8;
const NEAREST_M = 2.6;
const FARTHEST_M = 11;
const SIZE_M = 0.13;
/** Steps that never fall into a visible pattern (golden ratio and √2 less their whole parts). */
const SPREAD_X = 0.618;
const SPREAD_Z = 0.414;

interface Float {
  readonly from: Vector3;
  readonly to: Vector3;
  age_s: number;
}

export class Fleet {
  readonly group = new Group();
  private floats: Float[] = [];
  private readonly bodies: InstancedMesh;
  private readonly reflections: InstancedMesh;
  private readonly glow: Points;
  private readonly places = new BufferAttribute(new Float32Array(3 * MOST), 3);

  constructor() {
    const body = new CylinderGeometry(SIZE_M * 0.5, SIZE_M * 0.42, SIZE_M, 6);
    this.bodies = new InstancedMesh(body, new MeshBasicMaterial({ color: new Color("#ffb648") }), MOST);
    const streak = new PlaneGeometry(SIZE_M * 0.8, SIZE_M * 3);
    const shine = { color: new Color("#ffb648"), map: glowTexture(), transparent: true, opacity: 0.5 };
    this.reflections = new InstancedMesh(streak, new MeshBasicMaterial({ ...shine, depthWrite: false }), MOST);
    const halo = { map: glowTexture(), color: new Color("#ffdf9a"), size: 0.55, transparent: true, opacity: 0.7 };
    const geometry = new BufferGeometry().setAttribute("position", this.places);
    this.glow = new Points(geometry, new PointsMaterial({ ...halo, depthWrite: false }));
    for (const part of [this.bodies, this.reflections, this.glow]) {
      part.frustumCulled = false;
      part.renderOrder = -5;
      this.group.add(part);
    }
    this.count(0);
  }

  /** Lets so many lanterns float; a new one sets out `from` where it was won. */
  hold(count: number, from: Vector3 | null): void {
    const wanted = Math.min(count, MOST);
    if (this.floats.length > wanted) this.floats.length = wanted;
    while (this.floats.length < wanted) {
      const to = berth(this.floats.length);
      this.floats.push({ from: from ?? to, to, age_s: from ? 0 : GLIDE_S });
    }
  }

  animate({ dt_s, now_s, camera, still }: Moment): void {
    const facing = camera.quaternion;
    this.floats.forEach((float, i) => {
      float.age_s = still ? GLIDE_S : float.age_s + dt_s;
      this.put(i, placeOf(float, i, still ? 0 : now_s), facing);
    });
    this.count(this.floats.length);
  }

  /** Lets go of what disposing of shapes and paints leaves. */
  close(): void {
    this.bodies.dispose();
    this.reflections.dispose();
  }

  private put(i: number, place: Vector3, facing: Quaternion): void {
    this.bodies.setMatrixAt(i, new Matrix4().setPosition(place));
    const mirrored = new Vector3(place.x, 2 * WATER_Y - place.y - SIZE_M, place.z);
    this.reflections.setMatrixAt(i, new Matrix4().makeRotationFromQuaternion(facing).setPosition(mirrored));
    this.places.setXYZ(i, place.x, place.y, place.z);
  }

  private count(count: number): void {
    this.bodies.count = count;
    this.reflections.count = count;
    this.glow.geometry.setDrawRange(0, count);
    this.bodies.instanceMatrix.needsUpdate = true;
    this.reflections.instanceMatrix.needsUpdate = true;
    this.places.needsUpdate = true;
  }
}

/** Where lantern number `i` (from 0) comes to rest on the water. */
export function berth(i: number): Vector3 {
  const far = (0.15 + i * SPREAD_Z) % 1;
  const depth_m = NEAREST_M + (FARTHEST_M - NEAREST_M) * far * far;
  const across = ((0.5 + i * SPREAD_X) % 1) * 2 - 1;
  return new Vector3(across * depth_m * 0.85, WATER_Y + SIZE_M / 2, -depth_m);
}

/** On an easy curve down to the water, then swaying there. */
function placeOf({ from, to, age_s }: Float, i: number, now_s: number): Vector3 {
  const share = Math.min(1, age_s / GLIDE_S);
  const eased = share * share * (3 - 2 * share);
  const place = from.clone().lerp(to, eased);
  place.y += 0.5 * Math.sin(Math.PI * eased) * (share < 1 ? 1 : 0);
  if (share >= 1) place.y += 0.012 * Math.sin(now_s * 0.9 + i * 1.7);
  return place;
}
