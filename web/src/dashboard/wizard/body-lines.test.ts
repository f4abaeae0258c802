import { describe, expect, test } from "vitest";
import { armLines, frameOf, type Joint3, trunkLines } from "./body-lines";

/** Stands before the sensor and looks at it: its right shoulder is at the sensor's left (−x). */
function body(): Joint3[] {
  const joints: Joint3[] = Array.from({ length: 25 }, () => null);
  joints[4] = [0.2, 1.4, 2];
  joints[8] = [-0.2, 1.4, 2];
  joints[20] = [0, 1.4, 2];
  joints[9] = [-0.2, 1.1, 2];
  joints[10] = [-0.5, 1.1, 2];
  return joints;
}

describe("a body's lines", () => {
  test("have the body's right on the right and up above, whichever way it faces", () => {
    const joints = body();
    const frame = frameOf(joints);
    if (!frame) throw new Error("the shoulders are known");
    const [upper, lower] = armLines(joints, "right", frame);
    for (const [found, wanted] of [
      [upper, [0.2, 0, 0.2, 0.3]],
      [lower, [0.2, 0.3, 0.5, 0.3]],
    ] as const) {
      wanted.forEach((value, index) => {
        expect(found?.[index]).toBeCloseTo(value);
      });
    }
  });

  test("leave out what is not seen", () => {
    const joints = body();
    const frame = frameOf(joints);
    if (!frame) throw new Error("the shoulders are known");
    expect(trunkLines(joints, frame)).toHaveLength(2);
    expect(armLines(joints, "left", frame)).toHaveLength(0);
  });

  test("need both shoulders", () => {
    const joints = body();
    joints[4] = null;
    expect(frameOf(joints)).toBeNull();
  });
});
