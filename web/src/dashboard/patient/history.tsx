// A patient's sessions, newest first, each with the figures that say most.
import { useState } from "preact/hooks";
import { type Metric, otherSide, type SessionDetail } from "../../api/types";
import { t } from "../../strings";
import { dateAndTime, duration, figure, secondsBetween } from "../format";
import { hrefOf } from "../route";
import { Scroll } from "../scroll";
import { keyMetrics } from "../session/key-metrics";
import { amountOf, fullNameOf, identityOf } from "../session/metrics";

/** What fits on a screen; the rest on request. */
const NEWEST = 6;
const MOST_COLUMNS = 3;

export function History({ sessions }: { sessions: readonly SessionDetail[] }) {
  const [isWhole, setWhole] = useState(false);
  const newest = sessions.find((session) => session.metrics.length > 0);
  const columns = newest ? keyMetrics(newest.metrics, otherSide(newest.affected_side)).slice(0, MOST_COLUMNS) : [];
  const shown = isWhole ? sessions : sessions.slice(0, NEWEST);
  return (
    <>
      <Scroll label={t("history.title")}>
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
              <th>
                <span class="unseen">{t("history.links")}</span>
              </th>
            </tr>
          </thead>
          <tbody>
            {shown.map((session) => (
              <Row key={session.id} session={session} columns={columns} />
            ))}
          </tbody>
        </table>
      </Scroll>
      {shown.length < sessions.length && (
        <button type="button" onClick={() => setWhole(true)} data-testid="all-sessions">
          {t("history.all", { count: sessions.length })}
        </button>
      )}
    </>
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
      <td class="history-links">
        <a class="button" href={hrefOf({ page: "summary", id: session.id })} data-testid="open-summary">
          {t("history.look")}
        </a>
        {session.status !== "open" && (
          <a class="button" href={hrefOf({ page: "replay", id: session.id })} data-testid="history-replay">
            {t("replay.open")}
          </a>
        )}
      </td>
    </tr>
  );
}

function valueIn(session: SessionDetail, identity: string): string {
  const metric = session.metrics.find((one) => identityOf(one) === identity);
  return metric ? amountOf(metric) : "–";
}
