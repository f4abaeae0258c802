// Scores of standard tests over the same days as the figures above them.
import type { Score, Side } from "../../api/types";
import { t } from "../../strings";
import { GREATEST, KINDS, type Kind } from "../scores/scales";
import { Days, type Span, Wide, xOf } from "../time-chart";
import { middayOf } from "./days";

const HEIGHT = 84;
const TOP = 26;
const BOTTOM = 10;
const AXIS = 24;

interface Props {
  scores: readonly Score[];
  days: Span;
  affected: Side;
}

export function ScoreCard(props: Props) {
  return (
    <section class="card" data-testid="progress-scores">
      <h2>{t("progress.scores")}</h2>
      <Wide>{(width) => <ScoreStrips {...props} width={width} />}</Wide>
      <p class="small soft">{t("progress.scores.how")}</p>
    </section>
  );
}

/** A strip a test, of the affected arm; each on its own scale, with the points' own numbers. */
export function ScoreStrips({ scores, days, affected, width }: Props & { width: number }) {
  const of = (kind: Kind) => scores.filter((score) => score.kind === kind && score.side === affected);
  const kinds = KINDS.filter((kind) => of(kind).length > 0);
  return (
    <>
      {kinds.map((kind) => (
        <div key={kind}>
          <span class="small">
            <strong>{t(`score.${kind}`)}</strong> {t("progress.scores.scale", { most: GREATEST[kind] })}
          </span>
          <Strip kind={kind} scores={of(kind)} days={days} width={width} />
        </div>
      ))}
      <svg class="time-chart" width={width} height={AXIS} viewBox={`0 0 ${width} ${AXIS}`} aria-hidden="true">
        <Days width={width} y={16} days={days} />
      </svg>
    </>
  );
}

interface StripProps {
  kind: Kind;
  scores: readonly Score[];
  days: Span;
  width: number;
}

function Strip({ kind, scores, days, width }: StripProps) {
  const values = scores.map(({ value }) => value);
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const x = xOf(width, days);
  const y = (value: number) => HEIGHT - BOTTOM - ((HEIGHT - TOP - BOTTOM) * (value - low)) / Math.max(high - low, 1);
  const places = scores.map((score) => ({ score, at: x(middayOf(score.on)), level: y(score.value) }));
  const said = scores.map(({ on, value }) => `${on}: ${value}`).join(", ");
  return (
    <svg
      class="time-chart"
      width={width}
      height={HEIGHT}
      viewBox={`0 0 ${width} ${HEIGHT}`}
      role="img"
      aria-label={`${t(`score.${kind}`)}: ${said}`}
    >
      <line class="time-grid" x1={xOf(width, days)(days.from)} x2={x(days.to)} y1={HEIGHT - 1} y2={HEIGHT - 1} />
      <g class="time-line time-affected">
        <polyline points={places.map(({ at, level }) => `${at},${level}`).join(" ")} />
        {places.map(({ score, at, level }) => (
          <g key={score.id}>
            <rect x={at - 4.5} y={level - 4.5} width={9} height={9} />
            <text class="time-value" x={at} y={level - 9} text-anchor="middle">
              {score.value}
            </text>
          </g>
        ))}
      </g>
    </svg>
  );
}
