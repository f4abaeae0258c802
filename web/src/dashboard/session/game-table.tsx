// The figures of the games that were played, side by side.
import type { Metric } from "../../api/types";
import { Caveats, cell, firstOfEach } from "./joint-tables";
import { explanationOf, jointOf, nameOf } from "./metrics";

/** A row per figure, a column per game: games are few, figures are many. */
export function GameTable({ metrics }: { metrics: readonly Metric[] }) {
  const games = firstOfEach(metrics, (metric) => metric.joint);
  return (
    <>
      <div class="table-scroll">
        <table>
          <thead>
            <tr>
              <td />
              {games.map((game) => (
                <th class="number" key={game.joint}>
                  {jointOf(game)}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {firstOfEach(metrics, (metric) => metric.name).map((row) => (
              <tr key={row.name} data-testid="metric-row" data-metric={row.name}>
                <td>
                  {nameOf(row)}
                  <div class="figure-note">{explanationOf(row)}</div>
                </td>
                {games.map(({ joint }) => (
                  <td class="number" key={joint}>
                    {cell(metrics.find((metric) => metric.joint === joint && metric.name === row.name))}
                  </td>
                ))}
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      <Caveats metrics={metrics} />
    </>
  );
}
