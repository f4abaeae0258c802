// A uPlot chart that fills its place, in the dashboard's colours.
import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";

const FONT = "13px system-ui, sans-serif";
const GRID = { stroke: "#dbe2e8", width: 1 };
const INK = "#43525f";

/** Healthy solid, affected dashed: told apart without colour too. */
export const HEALTHY_LINE: uPlot.Series = { stroke: "#0b4f8a", width: 2.5, spanGaps: false };
export const AFFECTED_LINE: uPlot.Series = { stroke: "#b34700", width: 2.5, dash: [8, 5], spanGaps: false };

export const AXIS: uPlot.Axis = { stroke: INK, font: FONT, grid: GRID, ticks: { show: false } };

export type ChartOptions = Omit<uPlot.Options, "width" | "height">;

interface Props {
  options: ChartOptions;
  data: uPlot.AlignedData;
  height: number;
  label: string;
}

/** A chart of what is already known; drawn anew when options or data change. */
export function Chart({ options, data, height, label }: Props) {
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!place.current) return;
    const chart = fillingChart(place.current, options, data);
    return chart.destroy;
  }, [options, data]);
  return <div class="chart" role="img" aria-label={label} ref={place} style={{ height: `${height}px` }} />;
}

export interface FillingChart {
  chart: uPlot;
  destroy: () => void;
}

/** Puts a chart into `place` and keeps it as large as that. */
export function fillingChart(place: HTMLElement, options: ChartOptions, data: uPlot.AlignedData): FillingChart {
  const size = () => ({ width: Math.max(place.clientWidth, 50), height: Math.max(place.clientHeight, 50) });
  const chart = new uPlot({ ...options, ...size() }, data, place);
  const observer = new ResizeObserver(() => chart.setSize(size()));
  observer.observe(place);
  return {
    chart,
    destroy: () => {
      observer.disconnect();
      chart.destroy();
    },
  };
}
