// The arm that acts and the ghost of the arm that leads, each following its own points from the stream.
import { Group, type Vector3 } from "three";
import type { LiveMessage } from "../api/types";
import { Arm, poseOf } from "./arm";
import { dispose } from "./dispose";
import type { Side } from "./hand-shape";
import { affectedSide } from "./screen";
import { Follower } from "./smoothing";

type Tick = LiveMessage["tick"];

/** One side's pair of arms. */
class Pair {
  readonly acting: Arm;
  readonly ghost: Arm;

  constructor(readonly side: Side) {
    this.acting = new Arm(side, "solid");
    this.ghost = new Arm(side, "ghost");
  }
}

export class Limbs {
  readonly group = new Group();
  private readonly acting = new Follower();
  private readonly leading = new Follower();
  private pair: Pair | null = null;
  private ghostShown = false;

  constructor(private readonly onSide: (side: Side) => void) {}

  /** Takes a tick that arrived at `now_s` of this screen's clock. */
  take(tick: Tick, now_s: number): void {
    this.turnTo(affectedSide(tick.healthy_side));
    this.acting.take(tick.t_s, tick.affected.points_in_trunk.flat(), now_s);
    // While the device moves the arm, one arm is all there is to see: a second one would break the illusion.
    this.ghostShown = tick.state !== "engaged" && tick.session !== "" && tick.target?.valid === true;
    if (tick.target?.valid) this.leading.take(tick.t_s, tick.target.points_in_trunk.flat(), now_s);
  }

  /** Draws both arms as they are at `now_s`; returns the acting hand's place. */
  animate(now_s: number): Vector3 | null {
    if (!this.pair) return null;
    this.pair.ghost.group.visible = this.ghostShown;
    const leading = this.ghostShown ? this.leading.at(now_s) : null;
    if (leading) this.pair.ghost.move(poseOf(leading));
    const values = this.acting.at(now_s);
    if (!values) return null;
    const pose = poseOf(values);
    this.pair.acting.move(pose);
    return pose.hand;
  }

  private turnTo(side: Side): void {
    if (this.pair?.side === side) return;
    dispose(this.group);
    this.group.clear();
    this.acting.forget();
    this.leading.forget();
    this.pair = new Pair(side);
    this.group.add(this.pair.acting.group, this.pair.ghost.group);
    this.onSide(side);
  }
}
