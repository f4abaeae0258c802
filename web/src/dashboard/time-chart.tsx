// Values over days as a drawing that also prints sharply: lines, points, and a band of what may be chance.
import type { ComponentChildren } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { figure, locale } from "./format";
import "./time-chart.css";

export interface ChartPoint {
  at_ms: number;
  value: number;
}

export interface ChartLine {
  points: readonly ChartPoint[];
  /** "affected" is dashed with square points, "healthy" solid with round ones: told apart without colour. */
  look: "affected" | "healthy";
}

export interface Span {
  from: number;
  to: number;
}

export interface TimeChartProps {
  width: number;
  height: number;
  /** The days shown, in milliseconds. */
  days: Span;
  lines: readonly ChartLine[];
  band: Span | null;
  /** Behind every number on the upper axis. */
  sign: string;
  label: string;
}

const LEFT = 62;
const RIGHT = 18;
const TOP = 10;
const BOTTOM = 26;
const POINT = 4.5;
const DAY_WIDTH = 90;

export function TimeChart({ width, height, days, lines, band, sign, label }: TimeChartProps) {
  const values = lines.flatMap(({ points }) => points.map(({ value }) => value));
  const ticks = niceTicks(spanOf([...values, ...(band ? [band.from, band.to] : [])]));
  const [lowest = 0, highest = 1] = [ticks[0], ticks.at(-1)];
  const y = (value: number) => TOP + (height - TOP - BOTTOM) * (1 - (value - lowest) / (highest - lowest));
  const x = xOf(width, days);
  return (
    <svg
      class="time-chart"
      width={width}
      height={height}
      viewBox={`0 0 ${width} ${height}`}
      role="img"
      aria-label={label}
    >
      {band && (
        <rect
          class="time-band"
          x={LEFT}
          width={width - LEFT - RIGHT}
          y={y(band.to)}
          height={Math.max(y(band.from) - y(band.to), 1)}
        />
      )}
      {ticks.map((tick) => (
        <g key={tick}>
          <line class="time-grid" x1={LEFT} x2={width - RIGHT} y1={y(tick)} y2={y(tick)} />
          <text class="time-text" x={LEFT - 8} y={y(tick) + 4} text-anchor="end">
            {figure(tick, digitsOf(ticks))}
            {sign}
          </text>
        </g>
      ))}
      <Days width={width} y={height - 8} days={days} />
      {lines.map((line) => (
        <Line key={line.look} line={line} x={x} y={y} />
      ))}
    </svg>
  );
}

/** Where a moment lies from left to right; the same for every chart of that width and those days. */
export function xOf(width: number, days: Span): (at_ms: number) => number {
  return (at_ms) => LEFT + ((width - LEFT - RIGHT) * (at_ms - days.from)) / Math.max(days.to - days.from, 1);
}

export function Days({ width, y, days }: { width: number; y: number; days: Span }) {
  const count = Math.max(2, Math.min(8, Math.floor((width - LEFT) / DAY_WIDTH)));
  const x = xOf(width, days);
  const moments = Array.from({ length: count }, (_, k) => days.from + ((days.to - days.from) * k) / (count - 1));
  const names = moments.map((at) => new Date(at).toLocaleDateString(locale(), { day: "numeric", month: "short" }));
  return (
    <>
      {moments.map((at, k) =>
        names[k] === names[k - 1] ? null : (
          <text
            key={at}
            class="time-text"
            x={x(at)}
            y={y}
            text-anchor={k === 0 ? "start" : k === count - 1 ? "end" : "middle"}
          >
            {names[k]}
          </text>
        ),
      )}
    </>
  );
}

interface LineProps {
  line: ChartLine;
  x: (at_ms: number) => number;
  y: (value: number) => number;
}

function Line({ line: { points, look }, x, y }: LineProps) {
  const places = points.map(({ at_ms, value }) => [x(at_ms), y(value)] as const);
  return (
    <g class={`time-line time-${look}`}>
      <polyline points={places.map((place) => place.join(",")).join(" ")} />
      {places.map(([at, level], k) =>
        look === "affected" ? (
          <rect key={points[k]?.at_ms} x={at - POINT} y={level - POINT} width={2 * POINT} height={2 * POINT} />
        ) : (
          <circle key={points[k]?.at_ms} cx={at} cy={level} r={POINT} />
        ),
      )}
    </g>
  );
}

function spanOf(values: readonly number[]): Span {
  if (values.length === 0) return { from: 0, to: 1 };
  const [from, to] = [Math.min(...values), Math.max(...values)];
  return from < to ? { from, to } : { from: from - 0.5, to: to + 0.5 };
}

const STEPS = [1, 2, 5, 10];
const TICKS = 5;

/** Round numbers that enclose a span, about five of them. */
export function niceTicks({ from, to }: Span): number[] {
  const rough = (to - from) / TICKS;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * (STEPS.find((one) => one * power >= rough) ?? 10);
  const [first, last] = [Math.floor(from / step), Math.ceil(to / step)];
  return Array.from({ length: last - first + 1 }, (_, k) => (first + k) * step);
}

function digitsOf([first = 0, second = 1]: readonly number[]): number {
  return Math.min(3, Math.max(0, -Math.floor(Math.log10(second - first) + 1e-9)));
}

/** Gives its width to what is inside, and again whenever it changes. */
export function Wide({ children }: { children: (width: number) => ComponentChildren }) {
  const place = useRef<HTMLDivElement>(null);
  const [width, setWidth] = useState(0);
  useEffect(() => {
    if (!place.current) return;
    const observer = new ResizeObserver(([entry]) => entry && setWidth(Math.floor(entry.contentRect.width)));
    observer.observe(place.current);
    return () => observer.disconnect();
  }, []);
  return (
    <div class="time-wide" ref={place}>
      {width > 0 && children(width)}
    </div>
  );
}
