// Which few figures stand for a session where there is room for few.
import type { Metric, Side } from "../../api/types";

interface Wanted {
  name: string;
  joint?: string;
}

/** What therapists look at first, in order. */
const FIRST: readonly Wanted[] = [
  { name: "movements" },
  { name: "range_of_movement", joint: "elevation" },
  { name: "own_work_share" },
  { name: "own_range", joint: "elevation" },
  { name: "sparc" },
];

/** Those of `metrics` that say most, of the healthy arm: in passive mode the other one shows the drive. */
export function keyMetrics(metrics: readonly Metric[], healthySide: Side): Metric[] {
  return FIRST.flatMap(({ name, joint }) => {
    const family = metrics.filter((metric) => metric.name === name && (!joint || metric.joint === joint));
    const best = family.find((metric) => metric.side === healthySide) ?? family[0];
    return best ? [best] : [];
  });
}
