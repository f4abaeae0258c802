// Lotus open ahead of the boat, two to a stroke, and pass by.
import { describe, expect, it } from "vitest";
import { Lotus } from "./lotus";

function lakeAfter(gone_m: number): Lotus {
  const lotus = new Lotus();
  lotus.animate(0.02, gone_m, false);
  return lotus;
}

describe("Lotus", () => {
  it("opens two ahead of the boat, beside its course", () => {
    const opened = lakeAfter(37).open();
    expect(opened).toHaveLength(2);
    for (const { x, z } of opened) {
      expect(z).toBeLessThan(-2);
      expect(Math.abs(x)).toBeGreaterThan(1);
    }
  });

  it("opens none twice, and none where all in sight are open", () => {
    const lotus = lakeAfter(0);
    const all = Array.from({ length: 9 }, () => lotus.open()).flat();
    const places = new Set(all.map(({ x, z }) => `${x} ${z}`));
    expect(places.size).toBe(all.length);
    expect(lotus.open()).toEqual([]);
  });

  it("has new buds to open once the boat has gone on", () => {
    const lotus = lakeAfter(0);
    while (lotus.open().length > 0);
    lotus.animate(0.02, 12, false);
    expect(lotus.open()).toHaveLength(2);
  });
});
