// The report of a course of therapy: all sessions of a patient on a page.
import { listScores, readAdherence, readHistory, readPatient, readPlan, readProgress } from "../../api/client";
import {
  type Adherence,
  otherSide,
  type Patient,
  type Plan,
  type Progress,
  type Score,
  type SessionDetail,
  type Side,
} from "../../api/types";
import { t } from "../../strings";
import { dateText, dayOf, figure } from "../format";
import { useAsked } from "../hooks";
import { PatientTabs } from "../patient/tabs";
import { weeksSince } from "../plan/calendar";
import { ProblemBox } from "../problem";
import { daysOf } from "../progress/days";
import { armName, bandOf, chartLines } from "../progress/figure-card";
import { type Family, familiesOf, familyName, firstFamilies, mainLine, shownIn } from "../progress/lines";
import { type Span, TimeChart } from "../time-chart";
import { CourseFigures } from "./figures";
import { shortened } from "./lines-until";
import { Facts, GamesTable, Part, RangePictures, ScoresTable } from "./parts";
import { PrintBar, Sheet } from "./sheet";

const MOST_WEEKS = 104;
const CHARTS = 2;
const CHART_WIDTH = 336;
const CHART_HEIGHT = 150;
const SECONDS = 60;

interface Course {
  patient: Patient;
  /** Those that are over, oldest first. */
  sessions: readonly SessionDetail[];
  progress: Progress;
  scores: readonly Score[];
  plan: Plan | null;
  adherence: Adherence | null;
}

/** Everything that the page tells, asked for at once. */
async function readCourse(id: number): Promise<Course> {
  const [patient, sessions, progress, scores, plan] = await Promise.all([
    readPatient(id),
    readHistory(id),
    readProgress(id),
    listScores(id),
    readPlan(id),
  ]);
  const weeks = plan && Math.min(MOST_WEEKS, weeksSince(dayOf(plan.starts_on), new Date()));
  const adherence = weeks ? await readAdherence(id, weeks) : null;
  return { patient, sessions: overOldestFirst(sessions), progress, scores, plan, adherence };
}

function overOldestFirst(sessions: readonly SessionDetail[]): SessionDetail[] {
  return sessions
    .filter(({ status }) => status !== "open")
    .sort((a, b) => Date.parse(a.started_at ?? "") - Date.parse(b.started_at ?? ""));
}

export function CourseReport({ id }: { id: number }) {
  const course = useAsked(() => readCourse(id), id);
  return (
    <main class="page">
      <PatientTabs id={id} at="course-report" />
      <PrintBar />
      <ProblemBox problem={course.problem} onRetry={course.again} />
      {course.value && <Page course={course.value} />}
    </main>
  );
}

function Page({ course }: { course: Course }) {
  const { patient, sessions, progress, scores, plan } = course;
  const affected = otherSide(patient.healthy_side);
  const first = firstFamilies(familiesOf(progress.lines));
  return (
    <Sheet
      title={t("report.course.title")}
      name={patient.name}
      subject={`${t(`patient.affected.${affected}`)} · ${period(sessions)}`}
    >
      <Facts facts={factsOf(course)} />
      {plan?.note && <p class="notes">{shortened(plan.note)}</p>}
      <Part title={t("report.games")}>
        <GamesTable played={sessions.flatMap(({ played }) => played)} />
      </Part>
      <Part title={t("report.figures.course")}>
        <CourseFigures rows={rowsOf(first, affected)} affected={affected} />
        <div class="sheet-charts">
          {first.slice(0, CHARTS).map((family) => (
            <SmallChart key={family.id} family={family} affected={affected} days={daysOf(progress.lines, [])} />
          ))}
        </div>
      </Part>
      <Part title={t("progress.ranges")}>
        <RangePictures lines={progress.lines} affected={affected} />
      </Part>
      <Part title={t("scores.title")}>
        <ScoresTable scores={scores} />
      </Part>
      {patient.notes && (
        <Part title={t("report.notes")}>
          <p class="notes">{shortened(patient.notes)}</p>
        </Part>
      )}
    </Sheet>
  );
}

function rowsOf(families: readonly Family[], affected: Side) {
  return families.flatMap((family) => {
    const line = mainLine(family, affected);
    return line ? [{ family, line }] : [];
  });
}

function SmallChart({ family, affected, days }: { family: Family; affected: Side; days: Span }) {
  const line = mainLine(family, affected);
  if (!line) return null;
  return (
    <figure>
      <figcaption>
        {familyName(family)}{" "}
        {family.lines.map((one) => (
          <span key={one.side} class={one.side === affected ? "key key-affected" : "key"}>
            {armName(one, affected)}
          </span>
        ))}
      </figcaption>
      <TimeChart
        width={CHART_WIDTH}
        height={CHART_HEIGHT}
        days={days}
        lines={chartLines(family, affected)}
        band={bandOf(line)}
        sign={shownIn(line).sign}
        label={familyName(family)}
      />
    </figure>
  );
}

function period(sessions: readonly SessionDetail[]): string {
  const [first, last] = [sessions[0], sessions.at(-1)];
  if (!first || !last) return t("history.none");
  return t("range.between", { min: dateText(first.started_at), max: dateText(last.started_at) });
}

function factsOf({ sessions, plan, adherence }: Course): (readonly [string, string])[] {
  const minutes =
    sessions.reduce((all, { played }) => all + played.reduce((sum, one) => sum + one.played_s, 0), 0) / SECONDS;
  const [oldest, newest] = [sessions[0], sessions.at(-1)];
  const pain = (session: SessionDetail | undefined) =>
    `${figure(session?.pain_before)} → ${figure(session?.pain_after)}`;
  return [
    [t("report.sessions"), String(sessions.length)],
    [t("report.minutes-played"), figure(minutes)],
    [t("report.kept"), keptOf(plan, adherence)],
    [t("report.pain-first"), pain(oldest)],
    [t("report.pain-last"), pain(newest)],
  ];
}

function keptOf(plan: Plan | null, adherence: Adherence | null): string {
  if (!plan || !adherence) return t("report.no-plan");
  const planned = adherence.weeks.filter((week) => week.planned > 0);
  const sum = (of: "done" | "planned") => planned.reduce((all, week) => all + week[of], 0);
  return t("adherence.of", { done: sum("done"), planned: sum("planned") });
}
