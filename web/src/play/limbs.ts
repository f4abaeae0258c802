// The arm that acts, the ghost of the arm that leads, and where both act the healthy arm: each follows its own points
// from the stream.
import { Group, type Vector3 } from "three";
import type { LiveMessage } from "../api/types";
import { Arm, poseOf } from "./arm";
import { dispose } from "./dispose";
import type { Side } from "./hand-shape";
import { affectedSide } from "./screen";
import { Follower } from "./smoothing";

type Tick = LiveMessage["tick"];

/** The arms of a patient whose affected one is on that side. */
class Arms {
  readonly acting: Arm;
  readonly ghost: Arm;
  readonly healthy: Arm;

  constructor(readonly side: Side) {
    this.acting = new Arm(side, "solid");
    this.ghost = new Arm(side, "ghost");
    this.healthy = new Arm(side === "left" ? "right" : "left", "solid");
  }
}

/** Where the hands are as they are drawn; null where not known. */
export interface Hands {
  readonly acting: Vector3 | null;
  readonly healthy: Vector3 | null;
}

export class Limbs {
  readonly group = new Group();
  /** The healthy arm acts too and is drawn. */
  both = false;
  private readonly acting = new Follower();
  private readonly leading = new Follower();
  private readonly healthy = new Follower();
  private arms: Arms | null = null;
  private ghostShown = false;
  private healthySeen = false;

  constructor(private readonly onSide: (side: Side) => void) {}

  get side(): Side {
    return this.arms?.side ?? "right";
  }

  /** Takes a tick that arrived at `now_s` of this screen's clock. */
  take(tick: Tick, now_s: number): void {
    this.turnTo(affectedSide(tick.healthy_side));
    this.acting.take(tick.t_s, tick.affected.points_in_trunk.flat(), now_s);
    // While the device moves the arm, one arm is all there is to see: a second one would break the illusion.
    this.ghostShown = tick.state !== "engaged" && tick.session !== "" && tick.target?.valid === true;
    if (tick.target?.valid) this.leading.take(tick.t_s, tick.target.points_in_trunk.flat(), now_s);
    this.healthySeen = tick.healthy?.valid === true;
    if (tick.healthy?.valid) this.healthy.take(tick.t_s, tick.healthy.points_in_trunk.flat(), now_s);
  }

  /** Draws the arms as they are at `now_s`; says where the hands are. */
  animate(now_s: number): Hands {
    if (!this.arms) return { acting: null, healthy: null };
    const { acting, ghost, healthy } = this.arms;
    this.follow(ghost, this.ghostShown ? this.leading : null, now_s);
    return {
      acting: this.follow(acting, this.acting, now_s),
      healthy: this.animateHealthy(healthy, now_s),
    };
  }

  private animateHealthy(arm: Arm, now_s: number): Vector3 | null {
    const shown = this.follow(arm, this.both && this.healthySeen ? this.healthy : null, now_s);
    if (shown || !this.healthySeen) return shown;
    const values = this.healthy.at(now_s);
    return values && poseOf(values).hand;
  }

  /** Brings an arm to where its points are, or takes it out of sight. */
  private follow(arm: Arm, points: Follower | null, now_s: number): Vector3 | null {
    const values = points?.at(now_s);
    arm.group.visible = values !== undefined && values !== null;
    if (!values) return null;
    const pose = poseOf(values);
    arm.move(pose);
    return pose.hand;
  }

  private turnTo(side: Side): void {
    if (this.arms?.side === side) return;
    dispose(this.group);
    this.group.clear();
    for (const points of [this.acting, this.leading, this.healthy]) points.forget();
    this.arms = new Arms(side);
    this.group.add(this.arms.acting.group, this.arms.ghost.group, this.arms.healthy.group);
    this.onSide(side);
  }
}
