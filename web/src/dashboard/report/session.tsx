// The report of one session: a page for the patient's folder.
import { listScores, readProgress, readSession } from "../../api/client";
import type { Progress, ProgressLine, Score, SessionDetail } from "../../api/types";
import { t } from "../../strings";
import { dateAndTime, duration, figure, isoDay, secondsBetween } from "../format";
import { useAsked } from "../hooks";
import { ProblemBox } from "../problem";
import { type Family, familiesOf, firstFamilies, mainLine } from "../progress/lines";
import { hrefOf } from "../route";
import { SessionFigures } from "./figures";
import { linesUntil, measuredIn, shortened } from "./lines-until";
import { Facts, GamesTable, Part, RangePictures, ScoresTable } from "./parts";
import { PrintBar, Sheet } from "./sheet";

export function SessionReport({ id }: { id: number }) {
  const session = useAsked(() => readSession(id), id);
  return (
    <main class="page">
      <ProblemBox problem={session.problem} onRetry={session.again} />
      {session.value && <OfPatient session={session.value} />}
    </main>
  );
}

function OfPatient({ session }: { session: SessionDetail }) {
  const progress = useAsked(() => readProgress(session.patient_id), session.id);
  const scores = useAsked(() => listScores(session.patient_id), session.id);
  return (
    <>
      <PrintBar>
        <a class="button" href={hrefOf({ page: "summary", id: session.id })}>
          {t("report.to-session")}
        </a>
      </PrintBar>
      <ProblemBox problem={progress.problem ?? scores.problem} onRetry={progress.again} />
      {session.status === "open" && <p class="notice">{t("summary.status.open")}</p>}
      {progress.value && scores.value && <Page session={session} progress={progress.value} scores={scores.value} />}
    </>
  );
}

interface PageProps {
  session: SessionDetail;
  progress: Progress;
  scores: readonly Score[];
}

function Page({ session, progress, scores }: PageProps) {
  const known = linesUntil(progress.lines, session.started_at ?? "");
  const today = isoDay(new Date(session.started_at ?? ""));
  return (
    <Sheet
      title={t("report.session.title")}
      name={session.patient_name}
      subject={`${t(`patient.affected.${session.affected_side}`)} · ${dateAndTime(session.started_at)}`}
    >
      <Facts facts={factsOf(session)} />
      <Part title={t("report.games")}>
        <GamesTable played={session.played} />
      </Part>
      <Part title={t("report.figures")}>
        <SessionFigures rows={rowsOf(measuredIn(known, session.id), session)} affected={session.affected_side} />
      </Part>
      <Part title={t("progress.ranges")}>
        <RangePictures lines={measuredIn(known, session.id)} affected={session.affected_side} />
      </Part>
      <Part title={t("scores.title")}>
        <ScoresTable scores={scores.filter(({ on }) => on <= today)} />
      </Part>
      {session.notes && (
        <Part title={t("report.notes")}>
          <p class="notes">{shortened(session.notes)}</p>
        </Part>
      )}
    </Sheet>
  );
}

/** The figures that say most, of the arm that they say it of. */
function rowsOf(lines: readonly ProgressLine[], session: SessionDetail): { family: Family; line: ProgressLine }[] {
  return firstFamilies(familiesOf(lines)).flatMap((family) => {
    const line = mainLine(family, session.affected_side);
    return line ? [{ family, line }] : [];
  });
}

function factsOf(session: SessionDetail): (readonly [string, string])[] {
  const length = secondsBetween(session.started_at, session.ended_at);
  const count = (name: string) => figure(session.metrics.find((metric) => metric.name === name)?.value);
  return [
    [t("history.duration"), length === null ? "–" : duration(length)],
    [t("history.pain"), `${figure(session.pain_before)} → ${figure(session.pain_after)}`],
    [t("report.pain-calls"), count("pain_calls")],
    [t("report.soft-holds"), count("soft_holds")],
    [t("report.help"), t(`help.${session.assistance}`)],
    [t("summary.therapist"), session.therapist_name],
  ];
}
