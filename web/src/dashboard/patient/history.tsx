// A patient's sessions, newest first, each with the figures that say most.
import { type Metric, otherSide, type SessionDetail } from "../../api/types";
import { t } from "../../strings";
import { dateAndTime, duration, figure, secondsBetween } from "../format";
import { hrefOf } from "../route";
import { keyMetrics } from "../session/key-metrics";
import { amountOf, fullNameOf, identityOf } from "../session/metrics";

export function History({ sessions }: { sessions: readonly SessionDetail[] }) {
  const newest = sessions.find((session) => session.metrics.length > 0);
  const columns = newest ? keyMetrics(newest.metrics, otherSide(newest.affected_side)) : [];
  return (
    <div class="table-scroll">
      <table>
        <thead>
          <tr>
            <th>{t("history.when")}</th>
            <th class="number">{t("history.duration")}</th>
            <th class="number">{t("history.pain")}</th>
            {columns.map((metric) => (
              <th class="number" key={identityOf(metric)}>
                {fullNameOf(metric)}
              </th>
            ))}
            <th />
          </tr>
        </thead>
        <tbody>
          {sessions.map((session) => (
            <Row key={session.id} session={session} columns={columns} />
          ))}
        </tbody>
      </table>
    </div>
  );
}

function Row({ session, columns }: { session: SessionDetail; columns: readonly Metric[] }) {
  const length = secondsBetween(session.started_at, session.ended_at);
  return (
    <tr data-testid="session-row">
      <td>
        {dateAndTime(session.started_at)}
        {session.status !== "ended" && <div class="small caveat">{t(`session.status.${session.status}`)}</div>}
      </td>
      <td class="number">{length === null ? "–" : duration(length)}</td>
      <td class="number">
        {figure(session.pain_before)} → {figure(session.pain_after)}
      </td>
      {columns.map((column) => (
        <td class="number" key={identityOf(column)}>
          {valueIn(session, identityOf(column))}
        </td>
      ))}
      <td class="number">
        <a class="button" href={hrefOf({ page: "summary", id: session.id })} data-testid="open-summary">
          {t("history.look")}
        </a>
      </td>
    </tr>
  );
}

function valueIn(session: SessionDetail, identity: string): string {
  const metric = session.metrics.find((one) => identityOf(one) === identity);
  return metric ? amountOf(metric) : "–";
}
