// What was done of what was planned: a day a cell, a week a row.
import { readAdherence } from "../../api/client";
import type { Adherence, Plan } from "../../api/types";
import { t } from "../../strings";
import { dateText, dayOf, figure, isoDay, locale } from "../format";
import { useAsked } from "../hooks";
import { ProblemBox } from "../problem";
import { Scroll } from "../scroll";

const DAYS = 7;
const FEWEST_WEEKS = 4;
const MOST_WEEKS = 26;
const DAY_MS = 24 * 3600 * 1000;

type Week = Adherence["weeks"][number];
type Day = Adherence["days"][number];

export function Calendar({ plan }: { plan: Plan }) {
  const weeks = weeksShown(dayOf(plan.starts_on), new Date());
  const adherence = useAsked(() => readAdherence(plan.patient_id, weeks), plan.patient_id);
  return (
    <section class="card" data-testid="adherence">
      <h2>{t("adherence.title")}</h2>
      <p class="soft small">{t("adherence.why")}</p>
      <ProblemBox problem={adherence.problem} onRetry={adherence.again} />
      {adherence.value && <Weeks adherence={adherence.value} />}
    </section>
  );
}

/** Calendar weeks from the one of the first day to this one, and one for those that begin on another day than Monday. */
export function weeksSince(start: Date, today: Date): number {
  return Math.max(1, Math.ceil((today.getTime() - start.getTime()) / DAY_MS / DAYS) + 1);
}

/** Weeks to show: from the plan's first one, but not too few nor too many. */
export function weeksShown(start: Date, today: Date): number {
  return Math.min(Math.max(weeksSince(start, today), FEWEST_WEEKS), MOST_WEEKS);
}

function Weeks({ adherence: { days, weeks } }: { adherence: Adherence }) {
  return (
    <Scroll label={t("adherence.title")}>
      <table class="calendar">
        <thead>
          <tr>
            <th>{t("adherence.week")}</th>
            {days.slice(0, DAYS).map(({ on }) => (
              <th key={on} class="calendar-day">
                {dayOf(on).toLocaleDateString(locale(), { weekday: "short" })}
              </th>
            ))}
            <th class="number">{t("adherence.done")}</th>
          </tr>
        </thead>
        <tbody>
          {weeks.map((week, row) => (
            <WeekRow key={week.monday} week={week} days={days.slice(DAYS * row, DAYS * (row + 1))} />
          ))}
        </tbody>
      </table>
    </Scroll>
  );
}

function WeekRow({ week, days }: { week: Week; days: readonly Day[] }) {
  return (
    <tr data-testid="adherence-week" data-done={week.done} data-planned={week.planned}>
      <th scope="row">{dateText(week.monday)}</th>
      {days.map((day) => (
        <DayCell key={day.on} day={day} />
      ))}
      <td class="number">
        <strong>
          {week.planned > 0 ? t("adherence.of", { done: week.done, planned: week.planned }) : figure(week.done)}
        </strong>
        {week.planned > 0 && <div class="small">{t(kept(week))}</div>}
      </td>
    </tr>
  );
}

function kept({ done, planned }: Week) {
  if (done >= planned) return "adherence.kept";
  return done > 0 ? "adherence.partly" : "adherence.missed";
}

function DayCell({ day: { on, sessions, minutes } }: { day: Day }) {
  const isToday = on === isoDay(new Date());
  return (
    <td
      class={sessions > 0 ? "calendar-day calendar-done" : "calendar-day"}
      data-testid={sessions > 0 ? "day-done" : ""}
    >
      <span class="small soft">
        {dayOf(on).getDate()}
        {isToday && ` · ${t("adherence.today")}`}
      </span>
      {sessions > 0 && (
        <strong>
          ✓ {t("adherence.minutes", { minutes: figure(minutes, minutes < 10 ? 1 : 0) })}
          {sessions > 1 && <span class="small"> ×{sessions}</span>}
        </strong>
      )}
    </td>
  );
}
