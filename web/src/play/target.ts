// One target: a fruit inside a ring that closes as the hand comes near, and a thick arc that fills while it is held.
import {
  type Camera,
  Color,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  RingGeometry,
  Sprite,
  SpriteMaterial,
  type Vector3,
} from "three";
import type { TargetView } from "./changes";
import { fruit } from "./fruit";
import { glowTexture } from "./textures";

const APPEAR_S = 0.35;
const FADE_S = 0.6;
/** The fruit hangs this share of the zone's radius below its middle, so that a hand that arrives lies upon it. */
const BELOW = 0.72;
const RINGS_BELOW = 0.45;
/** The fruit fills this share of the zone in which it counts as reached. */
const FRUIT_SHARE = 0.62;
/** The closing ring is wider than the zone by this much per metre between hand and target. */
const OPENING_PER_M = 2.6;
const WIDEST = 2.3;
const ARC_STEPS = 64;

export class Target {
  readonly group = new Group();
  private readonly fruit: Group;
  private readonly facing = new Group();
  private readonly closing = ring(0.97, 1.03, "#ffffff", 0.95);
  private readonly closingEdge = ring(1.03, 1.075, "#1d3a52", 0.8);
  private readonly track = ring(1.07, 1.36, "#1d3a52", 0.85);
  private readonly arc = ring(1.12, 1.31, "#ffd23c", 1, ARC_STEPS);
  private readonly glow: Sprite;
  private age_s = 0;
  private leaving_s: number | null = null;
  private progress = 0;

  constructor(private view: TargetView) {
    this.fruit = fruit(view.id);
    this.glow = new Sprite(
      new SpriteMaterial({ map: glowTexture(), color: new Color("#fff3b0"), depthWrite: false, opacity: 0.75 }),
    );
    this.glow.scale.setScalar(3.6);
    this.glow.renderOrder = -1;
    this.facing.add(this.track, this.arc, this.closing, this.closingEdge);
    for (const part of [this.glow, this.fruit]) part.position.y = -BELOW;
    this.facing.position.y = -RINGS_BELOW;
    this.group.add(this.glow, this.fruit, this.facing);
    this.group.position.fromArray(view.position);
  }

  get position(): Vector3 {
    return this.group.position;
  }

  /** True once a target that left has faded away. */
  get gone(): boolean {
    return this.leaving_s !== null && this.leaving_s <= 0;
  }

  show(view: TargetView): void {
    this.view = view;
    this.group.position.fromArray(view.position);
  }

  /** The target was taken away: at once when it was reached, fading when it was not. */
  leave(reached: boolean): void {
    this.leaving_s ??= reached ? 0 : FADE_S;
  }

  /** Draws the next `dt_s`; `hand` is where the shown hand is. */
  animate(dt_s: number, hand: Vector3 | null, camera: Camera, still: boolean): void {
    this.age_s += dt_s;
    if (this.leaving_s !== null) this.leaving_s -= dt_s;
    const there = this.leaving_s === null ? 1 : Math.max(0, this.leaving_s / FADE_S);
    const size = this.view.radius_m * (still ? 1 : appear(this.age_s / APPEAR_S)) * (0.4 + 0.6 * there);
    this.group.scale.setScalar(Math.max(size, 1e-4));
    this.facing.quaternion.copy(camera.quaternion);
    this.facing.visible = this.leaving_s === null;
    this.glow.material.opacity = 0.75 * there;
    // Smoothed, because the rules' progress comes in steps of the stream.
    this.progress += (this.view.progress - this.progress) * Math.min(1, dt_s * 18);
    this.animateFruit(still);
    this.animateRings(hand);
  }

  private animateFruit(still: boolean): void {
    const swell = 1 + 0.16 * this.progress + (still ? 0 : 0.02 * Math.sin(this.age_s * 2.4));
    this.fruit.scale.setScalar(FRUIT_SHARE * swell);
    if (!still) this.fruit.rotation.y = 0.5 * Math.sin(this.age_s * 0.7);
  }

  private animateRings(hand: Vector3 | null): void {
    const gap_m = hand ? Math.max(0, hand.distanceTo(this.group.position) - this.view.radius_m) : 1;
    const opening = Math.min(WIDEST, 1 + gap_m * OPENING_PER_M);
    this.closing.scale.setScalar(opening);
    this.closingEdge.scale.setScalar(opening);
    const holding = this.progress > 0.01;
    this.track.visible = holding;
    this.arc.visible = holding;
    this.arc.geometry.setDrawRange(0, 6 * Math.ceil(ARC_STEPS * this.progress));
  }
}

/** A flat ring that is never hidden behind hand or fruit. Its arc runs clockwise from the top. */
function ring(inner: number, outer: number, color: string, opacity: number, steps = 48): Mesh<RingGeometry> {
  const geometry = new RingGeometry(inner, outer, steps, 1, Math.PI / 2, Math.PI * 2);
  geometry.scale(-1, 1, 1);
  const material = new MeshBasicMaterial({
    color: new Color(color),
    transparent: true,
    opacity,
    depthTest: false,
    side: DoubleSide,
  });
  const mesh = new Mesh(geometry, material);
  mesh.renderOrder = 8;
  return mesh;
}

/** Grows a little past its size and settles. */
function appear(share: number): number {
  if (share >= 1) return 1;
  const left = share - 1;
  return 1 + 2.4 * left ** 3 + 1.4 * left ** 2;
}
