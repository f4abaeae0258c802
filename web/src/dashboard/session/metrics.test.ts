import { describe, expect, test } from "vitest";
import type { Metric } from "../../api/types";
import { keyMetrics } from "./key-metrics";
import { amountOf, caveatsOf, fullNameOf, grouped, sharedCaveatsOf } from "./metrics";

const metric = (name: string, value: number | null, unit = "1", rest: Partial<Metric> = {}): Metric => ({
  name,
  value,
  unit,
  joint: "",
  side: "",
  label: `metric.${name}`,
  caveat: "",
  ...rest,
});

describe("a figure", () => {
  test("is said in everyday units", () => {
    expect(amountOf(metric("range_of_movement", Math.PI / 2, "rad"))).toBe("90°");
    expect(amountOf(metric("trunk_displacement", 0.034, "m"))).toBe("3.4 cm");
    expect(amountOf(metric("success_rate", 0.874))).toBe("87 %");
    expect(amountOf(metric("movements", 41))).toBe("41");
    expect(amountOf(metric("own_work_share", 0.314))).toBe("31 %");
    expect(amountOf(metric("own_effort", 1.27, "N m"))).toBe("1.3 Nm");
    expect(amountOf(metric("drive_work", 41.2, "J"))).toBe("41 J");
    expect(amountOf(metric("time_engaged", 244.2, "s"))).toBe("244 s");
  });

  test("that could not be measured says so", () => {
    expect(amountOf(metric("sparc", null))).toBe("not known");
  });

  test("that has no name here yet keeps the service's", () => {
    expect(fullNameOf(metric("grip_force", 3, "N"))).toBe("grip force");
    expect(amountOf(metric("grip_force", 3, "N"))).toBe("3.00 N");
  });
});

describe("the groups", () => {
  test("hold every figure once, also a new kind", () => {
    const all = ["movements", "sparc", "range_lowest", "lag", "time_hold", "sensor_residual", "grip_force"].map(
      (name) => metric(name, 1),
    );
    const groups = grouped(all);
    expect(groups.flatMap((group) => group.metrics)).toHaveLength(all.length);
    expect(groups.at(-1)).toMatchObject({ id: "other", metrics: [{ name: "grip_force" }] });
  });

  test("tell the arm's own part from the exoskeleton's", () => {
    const names = ["own_work", "drive_work", "own_work_share", "help", "own_effort", "own_range_lowest", "soft_holds"];
    const groups = grouped(names.map((name) => metric(name, 1)));
    expect(groups.map(({ id, metrics }) => [id, metrics.length])).toEqual([
      ["help", 5],
      ["own", 2],
    ]);
  });

  test("say a caveat once", () => {
    const caveat = "caveat.passive_drive";
    expect(caveatsOf([metric("lag", 1, "s", { caveat }), metric("symmetry", 1, "1", { caveat })])).toHaveLength(1);
  });

  test("share a caveat that more than one of them has", () => {
    const slow = ["movements", "movement_time"].map((name) => metric(name, 1, "1", { caveat: "caveat.slow" }));
    const alone = metric("sparc", -2, "1", { caveat: "caveat.sensor_noise" });
    expect(sharedCaveatsOf([...slow, alone])).toEqual([caveatsOf(slow)[0]]);
    expect(sharedCaveatsOf([alone, metric("help", 1), metric("help_allowed", 1)])).toEqual([]);
  });
});

describe("the key figures", () => {
  test("are the healthy arm's", () => {
    const ranges = (["right", "left"] as const).map((side) =>
      metric("range_of_movement", 1, "rad", { joint: "elevation", side }),
    );
    expect(keyMetrics(ranges, "left")).toEqual([ranges[1]]);
  });
});
