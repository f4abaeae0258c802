import { Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { type ArmPose, backOfHand, handDirectionOf, stationAt } from "./limb-line";

const bent: ArmPose = {
  shoulder: new Vector3(0.18, 0, 0),
  elbow: new Vector3(0.18, -0.29, 0),
  wrist: new Vector3(0.18, -0.29, -0.25),
  hand: new Vector3(0.18, -0.29, -0.33),
};
const mirrored = (v: Vector3) => new Vector3(-v.x, v.y, v.z);

describe("stationAt", () => {
  it("passes through shoulder and wrist, and near the elbow", () => {
    expect(stationAt(bent, 0).position.distanceTo(bent.shoulder)).toBeLessThan(1e-9);
    expect(stationAt(bent, 2).position.distanceTo(bent.wrist)).toBeLessThan(1e-9);
    expect(stationAt(bent, 1).position.distanceTo(bent.elbow)).toBeLessThan(0.05);
  });

  it("has no kink and no gap anywhere round the elbow", () => {
    for (let s = 0; s < 2; s += 0.005) {
      const [a, b] = [stationAt(bent, s), stationAt(bent, s + 0.005)];
      expect(a.position.distanceTo(b.position)).toBeLessThan(0.003);
      expect(a.tangent.angleTo(b.tangent)).toBeLessThan(0.06);
    }
  });
});

describe("backOfHand", () => {
  it("stands square on the hand's direction", () => {
    for (const direction of [
      new Vector3(0, 0, -1),
      new Vector3(-1, 0, 0),
      new Vector3(0, 1, 0),
      new Vector3(0, -1, 0),
    ]) {
      expect(backOfHand(direction, "right").dot(direction)).toBeCloseTo(0, 9);
    }
  });

  it("looks up while the hand points ahead or across the body", () => {
    expect(backOfHand(new Vector3(0, 0, -1), "right").y).toBeGreaterThan(0.8);
    expect(backOfHand(new Vector3(-1, 0, 0), "right").y).toBeGreaterThan(0.5);
  });

  it("is mirrored between the sides", () => {
    const direction = new Vector3(-0.4, 0.3, -0.8).normalize();
    const right = backOfHand(direction, "right");
    expect(mirrored(backOfHand(mirrored(direction), "left")).distanceTo(right)).toBeLessThan(1e-9);
  });

  it("turns little when the direction turns little", () => {
    const at = (angle: number) => backOfHand(new Vector3(Math.sin(angle), -0.2, -Math.cos(angle)).normalize(), "right");
    for (let angle = -1.5; angle < 1.5; angle += 0.02) expect(at(angle).angleTo(at(angle + 0.02))).toBeLessThan(0.05);
  });
});

describe("handDirectionOf", () => {
  it("takes the forearm's direction where no hand is known", () => {
    expect(handDirectionOf({ ...bent, hand: bent.wrist.clone() }).z).toBeCloseTo(-1, 9);
  });
});
