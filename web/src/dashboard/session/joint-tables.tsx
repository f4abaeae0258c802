// Figures that there are per joint, or per sensor, as tables.
import { type Metric, otherSide, type Side } from "../../api/types";
import { t } from "../../strings";
import { Scroll } from "../scroll";
import { amountOf, caveatsOf, explanationOf, jointOf, nameOf } from "./metrics";

/** A row per joint, a column per figure. */
export function JointTable({ metrics }: { metrics: readonly Metric[] }) {
  const columns = firstOfEach(metrics, (metric) => metric.name);
  return (
    <>
      <Scroll label={columns.map(nameOf).join(", ")}>
        <table>
          <thead>
            <tr>
              <td />
              {columns.map((metric) => (
                <th class="number" key={metric.name}>
                  {nameOf(metric)}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {firstOfEach(metrics, (metric) => metric.joint).map((row) => (
              <tr key={row.joint} data-testid="metric-row" data-metric={columns.map(({ name }) => name).join(" ")}>
                <td>{jointOf(row)}</td>
                {columns.map(({ name }) => (
                  <td class="number" key={name}>
                    {cell(metrics.find((metric) => metric.joint === row.joint && metric.name === name))}
                  </td>
                ))}
              </tr>
            ))}
          </tbody>
        </table>
      </Scroll>
      {columns.map(explanationOf).map(
        (text) =>
          text && (
            <p class="figure-note" key={text}>
              {text}
            </p>
          ),
      )}
      <Caveats metrics={metrics} />
    </>
  );
}

/** A row per joint: from where to where each arm moved. */
export function RangeTable({ metrics, affectedSide }: { metrics: readonly Metric[]; affectedSide: Side }) {
  const affected = metrics.filter((metric) => metric.side === affectedSide);
  const healthy = metrics.filter((metric) => metric.side === otherSide(affectedSide));
  return (
    <>
      <table>
        <thead>
          <tr>
            <td />
            <th class="number">{t("arm.healthy")}</th>
            <th class="number">{t("arm.affected")}</th>
          </tr>
        </thead>
        <tbody>
          {firstOfEach(metrics, (metric) => metric.joint).map((row) => (
            <tr key={row.joint} data-testid="metric-row" data-metric="range_of_movement">
              <td>{jointOf(row)}</td>
              <Range metrics={healthy} joint={row.joint} />
              <Range metrics={affected} joint={row.joint} />
            </tr>
          ))}
        </tbody>
      </table>
      <p class="figure-note">{t("figures.range.means")}</p>
      <Caveats metrics={affected} />
    </>
  );
}

function Range({ metrics, joint }: { metrics: readonly Metric[]; joint: string }) {
  const of = (name: string) => cell(metrics.find((metric) => metric.joint === joint && metric.name === name));
  return (
    <td class="number">
      <strong>{of("range_of_movement")}</strong>
      <div class="small soft">
        {of("range_lowest")} … {of("range_highest")}
      </div>
    </td>
  );
}

export function Caveats({ metrics }: { metrics: readonly Metric[] }) {
  return (
    <>
      {caveatsOf(metrics).map((caveat) => (
        <p class="figure-note caveat" key={caveat}>
          ⚠ {caveat}
        </p>
      ))}
    </>
  );
}

export function cell(metric: Metric | undefined): string {
  return metric ? amountOf(metric) : "–";
}

/** The first of each kind, in the order in which kinds appear. */
export function firstOfEach(metrics: readonly Metric[], kind: (metric: Metric) => string): Metric[] {
  return metrics.filter((metric, index) => metrics.findIndex((one) => kind(one) === kind(metric)) === index);
}
