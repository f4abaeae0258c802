// The last seconds of both arms' angles, for the live curves; a plain object, fed sixty times a second.
import { type ArmView, JOINTS, type Joint, type LiveTick } from "../../api/types";
import { degrees } from "../format";

export const SHOWN_S = 20;
/** Closer together than this, points fall on the same pixel. */
const SPACING_S = 0.04;

type Column = (number | null)[];

export class Traces {
  private readonly t_s: number[] = [];
  private readonly healthyDeg = eachJoint<Column>(() => []);
  private readonly affectedDeg = eachJoint<Column>(() => []);
  /** Grows with every point, so that a chart knows whether it has anything to draw. */
  version = 0;

  take(tick: LiveTick): void {
    const last = this.t_s.at(-1);
    if (last !== undefined && tick.t_s < last) this.forget();
    if (last !== undefined && tick.t_s >= last && tick.t_s - last < SPACING_S) return;
    this.t_s.push(tick.t_s);
    for (const joint of JOINTS) {
      this.healthyDeg[joint].push(angleOf(tick.healthy, joint));
      this.affectedDeg[joint].push(angleOf(tick.affected, joint));
    }
    while ((this.t_s[0] ?? tick.t_s) < tick.t_s - SHOWN_S) this.dropOldest();
    this.version += 1;
  }

  /** Seconds before now (≤ 0), healthy and affected degrees. */
  of(joint: Joint): [number[], Column, Column] {
    const now = this.t_s.at(-1) ?? 0;
    return [this.t_s.map((t) => t - now), this.healthyDeg[joint], this.affectedDeg[joint]];
  }

  /** The newest degrees of the healthy and the affected arm. */
  latest(joint: Joint): readonly [number | null, number | null] {
    return [this.healthyDeg[joint].at(-1) ?? null, this.affectedDeg[joint].at(-1) ?? null];
  }

  private dropOldest(): void {
    this.t_s.shift();
    for (const joint of JOINTS) {
      this.healthyDeg[joint].shift();
      this.affectedDeg[joint].shift();
    }
  }

  /** The station was started again: its clock begins anew. */
  private forget(): void {
    this.t_s.length = 0;
    for (const joint of JOINTS) {
      this.healthyDeg[joint].length = 0;
      this.affectedDeg[joint].length = 0;
    }
  }
}

function angleOf(arm: ArmView | null, joint: Joint): number | null {
  return arm?.valid ? degrees(arm[`${joint}_rad`]) : null;
}

function eachJoint<T>(make: () => T): Record<Joint, T> {
  return { plane: make(), elevation: make(), rotation: make(), elbow: make() };
}
