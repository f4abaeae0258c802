// Scores of standard tests over the same days as the figures above them.
import { listScales } from "../../api/client";
import type { Scale, Score, Side } from "../../api/types";
import { t } from "../../strings";
import { figure } from "../format";
import { useAsked } from "../hooks";
import { GREATEST, KINDS, type Kind } from "../scores/scales";
import { Days, type Span, Wide, xOf } from "../time-chart";
import { middayOf } from "./days";
import { saidOfScores } from "./lines";
import { ScaleSources } from "./sources";

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
  const scales = useAsked(listScales, "scales").value ?? [];
  return (
    <section class="card" data-testid="progress-scores">
      <h2>{t("progress.scores")}</h2>
      <Wide>{(width) => <ScoreStrips {...props} scales={scales} width={width} />}</Wide>
      <p class="small soft">{t("progress.scores.how")}</p>
      {scales.length > 0 && <ScaleSources scales={scales} />}
    </section>
  );
}

/** A strip a test, of the affected arm; each on its own scale, with the points' own numbers. */
function ScoreStrips({ scores, scales, days, affected, width }: Props & { scales: readonly Scale[]; width: number }) {
  const of = (kind: Kind) => scores.filter((score) => score.kind === kind && score.side === affected);
  const kinds = KINDS.filter((kind) => of(kind).length > 0);
  return (
    <>
      {kinds.map((kind) => (
        <div key={kind}>
          <p class="small">
            <strong>{t(`score.${kind}`)}</strong> {t("progress.scores.scale", { most: GREATEST[kind] })}.{" "}
            <ScoreVerdict values={of(kind).map(({ value }) => value)} scale={scales.find((one) => one.kind === kind)} />
          </p>
          <Strip kind={kind} scores={of(kind)} days={days} width={width} />
        </div>
      ))}
      <svg class="time-chart" width={width} height={AXIS} viewBox={`0 0 ${width} ${AXIS}`} aria-hidden="true">
        <Days width={width} y={16} days={days} />
      </svg>
    </>
  );
}

function ScoreVerdict({ values, scale }: { values: readonly number[]; scale: Scale | undefined }) {
  const mdc = scale?.mdc?.value ?? null;
  const difference = (values.at(-1) ?? 0) - (values[0] ?? 0);
  const words = { difference: `${difference > 0 ? "+" : ""}${figure(difference)}`, mdc: figure(mdc, 1) };
  return <span data-testid="score-verdict">{t(`progress.verdict.${saidOfScores(values, mdc)}`, words)}</span>;
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
