// What a session has shown: figures with what they mean, curves, and what happened.
import { readCurves, readEvents, readSession } from "../../api/client";
import type { SessionDetail } from "../../api/types";
import { t } from "../../strings";
import { gameName } from "../../strings/games";
import { dateAndTime, duration, figure, secondsBetween } from "../format";
import { useAsked } from "../hooks";
import { ProblemBox } from "../problem";
import { Afterwards } from "./afterwards";
import { SessionCurves } from "./curves";
import { EventList } from "./events";
import { Figures } from "./figures";
import { SessionLinks } from "./links";
import { PlayedGames } from "./played";

export function SummaryPage({ id }: { id: number }) {
  const session = useAsked(() => readSession(id), id);
  const curves = useAsked(() => readCurves(id), id);
  const events = useAsked(() => readEvents(id), id);
  return (
    <main class="page" data-testid="summary">
      <ProblemBox problem={session.problem} onRetry={session.again} />
      {session.value && <Head session={session.value} />}
      {session.value && (
        <div class="columns">
          <PlayedGames played={session.value.played} />
          <Afterwards key={session.value.id} session={session.value} onChanged={session.again} />
        </div>
      )}
      {session.value && (
        <Figures
          metrics={session.value.metrics}
          measured={session.value.measured}
          affectedSide={session.value.affected_side}
        />
      )}
      <ProblemBox problem={curves.problem} onRetry={curves.again} />
      {curves.value && <SessionCurves curves={curves.value} />}
      {events.value && <EventList events={events.value} />}
    </main>
  );
}

function Head({ session }: { session: SessionDetail }) {
  const length = secondsBetween(session.started_at, session.ended_at);
  const facts = [
    [t("history.when"), dateAndTime(session.started_at)],
    [t("history.duration"), length === null ? "–" : duration(length)],
    [t("summary.affected"), t(`side.${session.affected_side}`)],
    [t("summary.game"), session.exercises.map(({ game }) => gameName(game)).join(", ")],
    [t("history.pain"), `${figure(session.pain_before)} → ${figure(session.pain_after)}`],
    [t("summary.therapist"), session.therapist_name],
  ] as const;
  return (
    <>
      <div class="heading">
        <h1>{t("summary.title", { name: session.patient_name })}</h1>
        <SessionLinks session={session} />
      </div>
      {session.status !== "ended" && <p class="notice">{t(`summary.status.${session.status}`)}</p>}
      <dl class="facts card">
        {facts.map(([name, value]) => (
          <div key={name}>
            <dt class="small soft">{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
    </>
  );
}
