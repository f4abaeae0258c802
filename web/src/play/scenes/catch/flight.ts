// A butterfly on its way as the rules say, with its shadow on the stones; then it settles, or flies on.
import { CircleGeometry, Color, Group, Mesh, MeshBasicMaterial, Vector3 } from "three";
import type { ThingView } from "../../changes";
import type { Moment } from "../../scene";
import { TABLE_Y } from "../../table";
import { Butterfly } from "./butterfly";
import { isOverTerrace } from "./valley";

/** Wings as long as this share of the zone: what is easy to catch is easy to see. */
const WING_SHARE = 0.95;
const LEAST_WING_M = 0.06;
/** A butterfly that comes to its place sits on the back of the hand that waits there. */
export const ON_HAND_M = 0.05;
const FOLLOWING_PER_S = 14;
const LEAVES_S = 1.4;
const LEAVING_M_S = new Vector3(0.35, 0.42, -0.9);
const BOB_M = 0.035;
const SHADOW_OPACITY = 0.4;

/** The number of the butterfly that a thing belongs to: the rules give each two things, itself and its place. */
export function numberOf(id: number): number {
  return Math.ceil(id / 2);
}

export class Flight {
  readonly group = new Group();
  private readonly butterfly: Butterfly;
  private readonly shadow = new Mesh(
    new CircleGeometry(1, 20).rotateX(-Math.PI / 2),
    new MeshBasicMaterial({ color: new Color("#101a26"), transparent: true, depthWrite: false }),
  );
  private readonly at: Vector3;
  private readonly size_m: number;
  private age_s = 0;
  private leaving_s: number | null = null;

  constructor(private view: ThingView) {
    this.butterfly = new Butterfly(numberOf(view.id));
    this.size_m = Math.max(LEAST_WING_M, WING_SHARE * view.radius_m);
    this.butterfly.group.scale.setScalar(this.size_m);
    this.shadow.renderOrder = -2;
    this.at = new Vector3(...view.position);
    this.group.add(this.butterfly.group, this.shadow);
  }

  /** True once it has flown out of sight. */
  get isGone(): boolean {
    return this.leaving_s !== null && this.leaving_s >= LEAVES_S;
  }

  show(view: ThingView): void {
    this.view = view;
  }

  /** Nobody caught it: it flies on. */
  leave(): void {
    this.leaving_s ??= 0;
  }

  animate({ dt_s, still }: Moment): void {
    this.age_s += dt_s;
    const before = this.at.clone();
    if (this.leaving_s === null) this.at.lerp(new Vector3(...this.view.position), Math.min(1, FOLLOWING_PER_S * dt_s));
    else this.flyOn(dt_s, still);
    if (dt_s > 0) this.butterfly.head(this.at.clone().sub(before).divideScalar(dt_s), dt_s);
    this.butterfly.flutter(dt_s, false, still);
    this.put(still);
  }

  private flyOn(dt_s: number, still: boolean): void {
    this.leaving_s = (this.leaving_s ?? 0) + dt_s;
    const way = LEAVING_M_S.clone().multiplyScalar(still ? 0 : dt_s);
    if (this.at.x < 0) way.x *= -1;
    this.at.add(way);
    this.butterfly.fade(Math.max(0, 1 - this.leaving_s / LEAVES_S));
  }

  /** Draws it where it is, dancing a little until it comes down. */
  private put(still: boolean): void {
    const dancing = still ? 0 : 1 - 0.8 * this.view.progress;
    this.butterfly.group.position.copy(this.at);
    this.butterfly.group.position.y += ON_HAND_M + BOB_M * dancing * Math.sin(this.age_s * 4.3);
    this.butterfly.group.position.x += BOB_M * dancing * Math.sin(this.age_s * 2.9);
    this.shadow.visible = isOverTerrace(this.at.x, this.at.z);
    this.shadow.position.set(this.at.x, TABLE_Y + 0.003, this.at.z);
    this.shadow.scale.setScalar(this.size_m);
    this.shadow.material.opacity = this.leaving_s === null ? SHADOW_OPACITY : 0;
  }
}
