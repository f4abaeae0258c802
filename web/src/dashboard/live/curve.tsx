// One joint of both arms over the last seconds, drawn beside Preact in the browser's own rhythm.
import { useEffect, useRef, useState } from "preact/hooks";
import type uPlot from "uplot";
import { JOINTS, type Joint } from "../../api/types";
import { t } from "../../strings";
import { AFFECTED_LINE, AXIS, type ChartOptions, fillingChart, HEALTHY_LINE } from "../chart";
import { figure } from "../format";
import { type Feed, useFromFeed } from "./feed";
import { SHOWN_S } from "./traces";
import "./curve.css";

/** As often as an eye needs for a curve; the game on the other screen needs the processor more. */
const DRAWINGS_PER_S = 20;

/** A calm axis: it never shows less than this, and grows when a curve leaves it. */
const USUAL_DEG: Record<Joint, readonly [number, number]> = {
  plane: [-30, 120],
  elevation: [0, 120],
  rotation: [-60, 90],
  elbow: [0, 140],
};

export function LiveCurve({ feed, first }: { feed: Feed; first: Joint }) {
  const [joint, setJoint] = useState(first);
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => (place.current ? followTraces(place.current, feed, joint) : undefined), [feed, joint]);
  return (
    <section class="card live-curve">
      <div class="live-curve-said">
        <select
          value={joint}
          aria-label={t("exo.joint")}
          onChange={(event) => setJoint(event.currentTarget.value as Joint)}
          data-testid={`curve-${first}`}
        >
          {JOINTS.map((one) => (
            <option key={one} value={one}>
              {t(`joint.${one}`)}
            </option>
          ))}
        </select>
        <Now feed={feed} joint={joint} />
      </div>
      <div class="chart" ref={place} role="img" aria-label={t(`joint.${joint}`)} />
    </section>
  );
}

function Now({ feed, joint }: { feed: Feed; joint: Joint }) {
  // Drawn anew with each joint, so that the first look is at the right curve.
  return <Values key={joint} feed={feed} joint={joint} />;
}

function Values({ feed, joint }: { feed: Feed; joint: Joint }) {
  const [healthy, affected] = useFromFeed(feed, 4, ({ traces }) => traces.latest(joint));
  return (
    <>
      <span class="key">
        {t("arm.healthy.short")} <b>{inDegrees(healthy)}</b>
      </span>
      <span class="key key-affected">
        {t("arm.affected.short")} <b>{inDegrees(affected)}</b>
      </span>
    </>
  );
}

function inDegrees(angleDeg: number | null): string {
  return angleDeg === null ? "–" : `${figure(angleDeg)}°`;
}

/** Draws the traces until told to end. */
function followTraces(place: HTMLElement, feed: Feed, joint: Joint): () => void {
  const { chart, destroy } = fillingChart(place, optionsFor(joint), feed.traces.of(joint));
  let drawn = -1;
  const timer = setInterval(() => {
    if (feed.traces.version === drawn) return;
    drawn = feed.traces.version;
    chart.setData(feed.traces.of(joint));
  }, 1000 / DRAWINGS_PER_S);
  return () => {
    clearInterval(timer);
    destroy();
  };
}

function optionsFor(joint: Joint): ChartOptions {
  const [low, high] = USUAL_DEG[joint];
  const range: uPlot.Range.Function = (_, min, max) => [Math.min(low, min ?? low), Math.max(high, max ?? high)];
  return {
    legend: { show: false },
    cursor: { show: false },
    padding: [6, 16, 0, 0],
    axes: [
      { ...AXIS, size: 24, values: (_, splits) => splits.map((second) => `${second} s`) },
      { ...AXIS, size: 48, space: 24, values: (_, splits) => splits.map((angle) => `${angle}°`) },
    ],
    scales: { x: { time: false, range: [-SHOWN_S, 0] }, y: { range } },
    series: [{}, HEALTHY_LINE, AFFECTED_LINE],
  };
}
