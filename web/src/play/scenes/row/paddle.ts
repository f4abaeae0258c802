// A paddle in one hand: lifted over the water on the way ahead, dipped into it while it pulls.
import { Color, CylinderGeometry, Group, Mesh, MeshLambertMaterial, SphereGeometry, Vector3 } from "three";
import { WATER_Y } from "./water";

const ABOVE_HAND_M = 0.16;
const SHAFT_RADIUS_M = 0.012;
const BLADE_M = { across: 0.075, along: 0.19, through: 0.018 } as const;
const WOOD = new Color("#e8c48c");
const BLADE = new Color("#d8452e");
const DIPPED = { outward: 0.6, below_water: 0.08, ahead: 0.14 } as const;
const LIFTED = { outward: 0.6, below_water: -0.16, ahead: 0.14 } as const;
const DIPPING_PER_S = 7;
const UP = new Vector3(0, 1, 0);

export class Paddle {
  readonly group = new Group();
  private readonly shaft = new Mesh(
    new CylinderGeometry(SHAFT_RADIUS_M, SHAFT_RADIUS_M, 1, 8),
    new MeshLambertMaterial({ color: WOOD }),
  );
  private readonly blade = new Mesh(new SphereGeometry(1, 14, 8), new MeshLambertMaterial({ color: BLADE }));
  private dip = 0;

  /** `outward` is +1 on the patient's right side, −1 on the left. */
  constructor(private readonly outward: 1 | -1) {
    this.blade.scale.set(BLADE_M.across, BLADE_M.along, BLADE_M.through);
    this.group.add(this.shaft, this.blade);
  }

  /** Where the blade is. */
  get tip(): Vector3 {
    return this.blade.position;
  }

  /** Whether the blade is in the water. */
  get isDipped(): boolean {
    return this.dip > 0.6;
  }

  animate(dt_s: number, hand: Vector3 | null, pulls: boolean): void {
    this.group.visible = hand !== null;
    if (!hand) return;
    this.dip += ((pulls ? 1 : 0) - this.dip) * Math.min(1, DIPPING_PER_S * dt_s);
    const mixed = (name: keyof typeof DIPPED) => LIFTED[name] + this.dip * (DIPPED[name] - LIFTED[name]);
    const tip = new Vector3(hand.x + this.outward * mixed("outward"), WATER_Y - mixed("below_water"), 0);
    tip.z = hand.z - mixed("ahead");
    const along = tip.clone().sub(hand).normalize();
    const top = hand.clone().addScaledVector(along, -ABOVE_HAND_M);
    this.shaft.position.copy(top).lerp(tip, 0.5);
    this.shaft.scale.y = top.distanceTo(tip);
    this.blade.position.copy(tip);
    for (const part of [this.shaft, this.blade]) part.quaternion.setFromUnitVectors(UP, along);
  }
}
