// One patient on the list of today: what is planned, what is missing, and the button that starts.
import { otherSide, type PatientToday } from "../../api/types";
import { t } from "../../strings";
import { gameName } from "../../strings/games";
import { dateText, figure } from "../format";
import { hrefOf } from "../route";

export function PatientRow({ row }: { row: PatientToday }) {
  return (
    <article class={row.due ? "card today-row today-due" : "card today-row"} data-testid="today-row" data-due={row.due}>
      <div class="today-who">
        <h3>
          <a href={hrefOf({ page: "patient", id: row.id })} data-testid="patient">
            {row.name}
          </a>
        </h3>
        <span class="small">{t(`patient.affected.${otherSide(row.healthy_side)}`)}</span>
      </div>
      <div class="today-plan">
        <Planned row={row} />
        <Missing row={row} />
      </div>
      <a
        class={row.due ? "button primary big" : "button primary"}
        href={hrefOf({ page: "prepare", id: row.id })}
        aria-label={t("today.start.for", { name: row.name })}
        data-testid="open-session"
      >
        {t("session.open")}
      </a>
    </article>
  );
}

function Planned({ row: { plan, done_this_week, planned_this_week, last_session } }: { row: PatientToday }) {
  return (
    <>
      {plan && (
        <p>
          <strong>{plan.exercises.map(({ game }) => gameName(game)).join(" · ")}</strong>{" "}
          {t("today.minutes", { minutes: figure(plan.minutes) })}
        </p>
      )}
      <p class="small">
        {plan && planned_this_week > 0 && <Week done={done_this_week} planned={planned_this_week} />}
        {plan && `${weekOf(plan)} · `}
        {last_session
          ? t("today.last", {
              day: dateText(last_session.started_at),
              minutes: figure(last_session.minutes, last_session.minutes < 10 ? 1 : 0),
            })
          : t("today.last.none")}
      </p>
    </>
  );
}

/** This week's sessions as dots, and in words. */
function Week({ done, planned }: { done: number; planned: number }) {
  return (
    <>
      <span class="today-dots" aria-hidden="true">
        {"●".repeat(done)}
        {"○".repeat(Math.max(0, planned - done))}
      </span>{" "}
      {t("today.week", { done, planned })} ·{" "}
    </>
  );
}

function weekOf({ week, weeks }: NonNullable<PatientToday["plan"]>): string {
  if (week === 0) return t("today.plan.later");
  return week > weeks ? t("today.plan.over") : t("today.plan.week", { week, weeks });
}

/** What should be done before the session; the limits must be. */
function Missing({ row: { id, limits_signed, plan } }: { row: PatientToday }) {
  return (
    <>
      {!limits_signed && (
        <p class="small caveat">
          ⚠ {t("prepare.limits.missing")} <a href={hrefOf({ page: "patient", id })}>{t("today.limits")}</a>
        </p>
      )}
      {!plan && (
        <p class="small">
          {t("today.plan.none")} <a href={hrefOf({ page: "plan", id })}>{t("programme.make")}</a>
        </p>
      )}
    </>
  );
}
