// The line through an arm: shoulder to elbow to wrist with a rounded elbow, and how the hand is turned about it.
import { Quaternion, Vector3 } from "three";

export interface ArmPose {
  readonly shoulder: Vector3;
  readonly elbow: Vector3;
  readonly wrist: Vector3;
  readonly hand: Vector3;
}

/** Half the length over which the elbow is rounded. */
const ELBOW_ROUNDING_M = 0.065;
/** A resting forearm points ahead and a little down; there the back of the hand looks up and a little outward. */
const REST_FOREARM = new Vector3(0, -0.3, -0.95).normalize();
const REST_BACK_UP = 1;
const REST_BACK_OUTWARD = 0.35;

export interface Station {
  readonly position: Vector3;
  readonly tangent: Vector3;
}

/** Point and direction at `s`: 0 = shoulder, 1 = elbow, 2 = wrist; beyond both ends it runs on straight. */
export function stationAt(pose: ArmPose, s: number): Station {
  const upper = pose.elbow.clone().sub(pose.shoulder);
  const fore = pose.wrist.clone().sub(pose.elbow);
  const along = s <= 1 ? upper : fore;
  const beforeElbow_m = (s - 1) * along.length();
  const u = upper.clone().normalize();
  const f = fore.clone().normalize();
  if (Math.abs(beforeElbow_m) >= ELBOW_ROUNDING_M) {
    const tangent = s <= 1 ? u : f;
    return { position: pose.elbow.clone().addScaledVector(tangent, beforeElbow_m), tangent };
  }
  return rounded(pose.elbow, u, f, (beforeElbow_m / ELBOW_ROUNDING_M + 1) / 2);
}

/** A quadratic Bézier round the elbow, `t` from 0 to 1. */
function rounded(elbow: Vector3, u: Vector3, f: Vector3, t: number): Station {
  const before = elbow.clone().addScaledVector(u, -ELBOW_ROUNDING_M * (1 - t) ** 2);
  const tangent = u
    .clone()
    .multiplyScalar(1 - t)
    .addScaledVector(f, t);
  return { position: before.addScaledVector(f, ELBOW_ROUNDING_M * t * t), tangent: tangent.normalize() };
}

/** Direction of the forearm (elbow to wrist). */
export function forearmOf(pose: ArmPose): Vector3 {
  return pose.wrist.clone().sub(pose.elbow).normalize();
}

/** Direction of the hand; the forearm's where wrist and hand coincide. */
export function handDirectionOf(pose: ArmPose): Vector3 {
  const direction = pose.hand.clone().sub(pose.wrist);
  return direction.length() > 0.01 ? direction.normalize() : forearmOf(pose);
}

/**
 * The direction in which the back of the hand looks when the hand points along `direction`.
 *
 * No sensor tells how the forearm is turned, so it takes the least rotation from a resting hand. That is smooth
 * everywhere but for a hand pointing straight back over the shoulder, where no hand goes.
 */
export function backOfHand(direction: Vector3, side: "left" | "right"): Vector3 {
  const outward = side === "left" ? -REST_BACK_OUTWARD : REST_BACK_OUTWARD;
  const rest = new Vector3(outward, REST_BACK_UP, 0).projectOnPlane(REST_FOREARM).normalize();
  return rest.applyQuaternion(new Quaternion().setFromUnitVectors(REST_FOREARM, direction));
}
