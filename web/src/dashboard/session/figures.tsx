// The figures of a session in groups, each with its plain meaning and what must be said beside it.
import type { Metric, Side } from "../../api/types";
import { t } from "../../strings";
import { JointTable, RangeTable } from "./joint-tables";
import { amountOf, caveatOf, explanationOf, fullNameOf, type Group, grouped, identityOf } from "./metrics";

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
  if (group.byJoint) return <JointTable metrics={group.metrics} />;
  return (
    <div class="figures">
      {group.metrics.map((metric) => (
        <Figure key={identityOf(metric)} metric={metric} />
      ))}
    </div>
  );
}

function Figure({ metric }: { metric: Metric }) {
  const explanation = explanationOf(metric);
  const caveat = caveatOf(metric);
  return (
    <div class="figure" data-testid="metric-row" data-metric={metric.name}>
      <span>{fullNameOf(metric)}</span>
      <span class="figure-value">{amountOf(metric)}</span>
      {explanation && <span class="figure-note">{explanation}</span>}
      {caveat && <span class="figure-note caveat">⚠ {caveat}</span>}
    </div>
  );
}
