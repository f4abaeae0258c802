// The figures of a session in groups, each with its plain meaning and what must be said beside it.
import type { Metric, Side } from "../../api/types";
import { t } from "../../strings";
import { GameTable } from "./game-table";
import { JointTable, RangeTable } from "./joint-tables";
import {
  amountOf,
  caveatOf,
  explanationOf,
  fullNameOf,
  type Group,
  grouped,
  identityOf,
  sharedCaveatsOf,
} from "./metrics";

interface Props {
  metrics: readonly Metric[];
  measured: boolean;
  affectedSide: Side;
}

export function Figures({ metrics, measured, affectedSide }: Props) {
  if (metrics.length === 0) {
    return <p class="notice">{t(measured ? "figures.none" : "figures.unmeasured")}</p>;
  }
  return (
    <div class="columns">
      {grouped(metrics).map((group) => (
        <section class="card" key={group.id}>
          <h2>{t(`figures.${group.id}`)}</h2>
          <GroupFigures group={group} affectedSide={affectedSide} />
        </section>
      ))}
    </div>
  );
}

function GroupFigures({ group, affectedSide }: { group: Group; affectedSide: Side }) {
  if (group.id === "range") return <RangeTable metrics={group.metrics} affectedSide={affectedSide} />;
  if (group.id === "games") return <GameTable metrics={group.metrics} />;
  if (group.byJoint) return <JointTable metrics={group.metrics} />;
  const shared = sharedCaveatsOf(group.metrics);
  return (
    <div class="figures">
      {group.metrics.map((metric) => (
        <Figure key={identityOf(metric)} metric={metric} shared={shared} />
      ))}
      {shared.map((caveat, index) => (
        <p class="figure-note caveat" key={caveat}>
          {signOf(index)} {caveat}
        </p>
      ))}
    </div>
  );
}

/** A figure; a caveat that others share is said once below them all. */
function Figure({ metric, shared }: { metric: Metric; shared: readonly string[] }) {
  const explanation = explanationOf(metric);
  const caveat = caveatOf(metric);
  const index = shared.indexOf(caveat);
  return (
    <div class="figure" data-testid="metric-row" data-metric={metric.name}>
      <span>
        {fullNameOf(metric)} {index >= 0 && <span class="caveat">{signOf(index)}</span>}
      </span>
      <span class="figure-value">{amountOf(metric)}</span>
      {explanation && <span class="figure-note">{explanation}</span>}
      {caveat && index < 0 && <span class="figure-note caveat">⚠ {caveat}</span>}
    </div>
  );
}

function signOf(index: number): string {
  return `⚠${index + 1}`;
}
