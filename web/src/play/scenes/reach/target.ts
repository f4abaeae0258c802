// One target: a fruit that hangs in the ring that closes as the hand comes near and fills while it stays.
import { type Camera, Color, Group, Sprite, SpriteMaterial, type Vector3 } from "three";
import type { ThingView } from "../../changes";
import { DwellRing, gapTo } from "../../dwell-ring";
import { glowTexture } from "../../textures";
import { fruit } from "./fruit";

const APPEAR_S = 0.35;
const FADE_S = 0.6;
/** The fruit hangs this share of the zone's radius below its middle, so that a hand that arrives lies upon it. */
const BELOW = 0.72;
const RINGS_BELOW = 0.45;
/** The fruit fills this share of the zone in which it counts as reached. */
const FRUIT_SHARE = 0.62;

export class Target {
  readonly group = new Group();
  private readonly fruit: Group;
  private readonly rings = new DwellRing();
  private readonly glow: Sprite;
  private age_s = 0;
  private leaving_s: number | null = null;

  constructor(private view: ThingView) {
    this.fruit = fruit(view.id);
    this.glow = new Sprite(
      new SpriteMaterial({ map: glowTexture(), color: new Color("#fff3b0"), depthWrite: false, opacity: 0.75 }),
    );
    this.glow.scale.setScalar(3.6);
    this.glow.renderOrder = -1;
    for (const part of [this.glow, this.fruit]) part.position.y = -BELOW;
    this.rings.group.position.y = -RINGS_BELOW;
    this.group.add(this.glow, this.fruit, this.rings.group);
    this.group.position.set(...view.position);
  }

  get position(): Vector3 {
    return this.group.position;
  }

  /** True once a target that left has faded away. */
  get gone(): boolean {
    return this.leaving_s !== null && this.leaving_s <= 0;
  }

  show(view: ThingView): void {
    this.view = view;
    this.group.position.set(...view.position);
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
    this.glow.material.opacity = 0.75 * there;
    this.rings.group.visible = this.leaving_s === null;
    this.rings.animate(dt_s, gapTo(hand, this.group.position, this.view.radius_m), this.view.progress, camera);
    this.animateFruit(still);
  }

  private animateFruit(still: boolean): void {
    const swell = 1 + 0.16 * this.rings.share + (still ? 0 : 0.02 * Math.sin(this.age_s * 2.4));
    this.fruit.scale.setScalar(FRUIT_SHARE * swell);
    if (!still) this.fruit.rotation.y = 0.5 * Math.sin(this.age_s * 0.7);
  }
}

/** Grows a little past its size and settles. */
function appear(share: number): number {
  if (share >= 1) return 1;
  const left = share - 1;
  return 1 + 2.4 * left ** 3 + 1.4 * left ** 2;
}
