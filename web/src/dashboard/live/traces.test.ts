import { describe, expect, test } from "vitest";
import type { ArmView, LiveTick } from "../../api/types";
import { SHOWN_S, Traces } from "./traces";

const arm = (elevation_rad: number, valid = true) =>
  ({ plane_rad: 0, elevation_rad, rotation_rad: 0, elbow_rad: 0, valid }) as ArmView;
const tick = (t_s: number, healthy: ArmView | null = arm(1)) => ({ t_s, healthy, affected: arm(0.5) }) as LiveTick;

describe("the traces", () => {
  test("hold no more than is shown, and end now", () => {
    const traces = new Traces();
    for (let t = 0; t < 3 * SHOWN_S; t += 0.01) traces.take(tick(t));
    const [seconds, healthy, affected] = traces.of("elevation");
    expect(seconds.at(-1)).toBe(0);
    expect(seconds[0]).toBeGreaterThanOrEqual(-SHOWN_S);
    expect(healthy).toHaveLength(seconds.length);
    expect(affected).toHaveLength(seconds.length);
    expect(seconds.length).toBeLessThan(SHOWN_S * 30);
  });

  test("leave a gap where an arm is not known", () => {
    const traces = new Traces();
    traces.take(tick(0, null));
    traces.take(tick(1, arm(1, false)));
    traces.take(tick(2));
    expect(traces.of("elevation")[1].slice(0, 2)).toEqual([null, null]);
    expect(traces.latest("elevation")[0]).toBeCloseTo(57.3, 1);
  });

  test("begin anew when the station's clock does", () => {
    const traces = new Traces();
    traces.take(tick(100));
    traces.take(tick(1));
    expect(traces.of("elbow")[0]).toEqual([0]);
  });
});
