// One figure over a patient's sessions, as a curve.
import { useMemo, useState } from "preact/hooks";
import type uPlot from "uplot";
import { otherSide, type SessionDetail } from "../../api/types";
import { t } from "../../strings";
import { AXIS, Chart, type ChartOptions } from "../chart";
import { degrees } from "../format";
import { keyMetrics } from "../session/key-metrics";
import { fullNameOf, identityOf, seriesOf } from "../session/metrics";

const HEIGHT_PX = 190;
/** A curve needs two points. */
const FEWEST = 2;

const OPTIONS: ChartOptions = {
  legend: { show: false },
  cursor: { show: false },
  axes: [
    { ...AXIS, values: (_, splits) => splits.map((index) => (Number.isInteger(index) ? String(index) : "")) },
    { ...AXIS, size: 56 },
  ],
  scales: { x: { time: false } },
  series: [{}, { stroke: "#0b4f8a", width: 2.5, points: { show: true, size: 9, fill: "#0b4f8a" } }],
};

export function Trend({ sessions }: { sessions: readonly SessionDetail[] }) {
  const newest = sessions.find((session) => session.metrics.length > 0);
  const choices = newest ? keyMetrics(newest.metrics, otherSide(newest.affected_side)) : [];
  const [chosen, setChosen] = useState<string | null>(null);
  const identity = chosen ?? (choices[0] ? identityOf(choices[0]) : "");
  const data = useMemo(() => dataOf(sessions, identity), [sessions, identity]);
  if (sessions.length < FEWEST || choices.length === 0) return null;
  return (
    <div>
      <div class="row">
        {choices.map((metric) => (
          <button
            key={identityOf(metric)}
            type="button"
            class="choice choice-low"
            aria-pressed={identityOf(metric) === identity}
            onClick={() => setChosen(identityOf(metric))}
          >
            {fullNameOf(metric)}
          </button>
        ))}
      </div>
      <Chart options={OPTIONS} data={data} height={HEIGHT_PX} label={t("history.trend")} />
      <p class="small soft">{t("history.trend")}</p>
    </div>
  );
}

/** Sessions counted from the oldest against the figure, angles in degrees. */
function dataOf(sessions: readonly SessionDetail[], identity: string): uPlot.AlignedData {
  const series = seriesOf(sessions, identity);
  return [
    series.map((_, index) => index + 1),
    series.map(({ value, unit }) => (unit === "rad" ? degrees(value ?? 0) : value)),
  ];
}
