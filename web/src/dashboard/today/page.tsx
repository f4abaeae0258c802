// The first page: whose session is due, what is missing for it, and all patients.
import { useState } from "preact/hooks";
import { currentSession, readToday } from "../../api/client";
import type { PatientToday, Session } from "../../api/types";
import { t } from "../../strings";
import { locale } from "../format";
import { useAsked } from "../hooks";
import { ProblemBox } from "../problem";
import { hrefOf } from "../route";
import { PatientRow } from "./row";
import { matching } from "./search";
import "./today.css";

export function TodayPage() {
  const today = useAsked(readToday, "today");
  const current = useAsked(currentSession, "current");
  return (
    <main class="page">
      <div class="heading">
        <h1>{t("today.title", { day: new Date().toLocaleDateString(locale(), { dateStyle: "full" }) })}</h1>
        <a class="button" href={hrefOf({ page: "enrol" })} data-testid="new-patient">
          {t("patients.new")}
        </a>
      </div>
      <ProblemBox problem={today.problem ?? current.problem} onRetry={today.again} />
      {current.value && <OpenSession session={current.value} />}
      {today.value?.length === 0 && <p class="card">{t("patients.none")}</p>}
      {today.value && today.value.length > 0 && <Patients rows={today.value} />}
    </main>
  );
}

function OpenSession({ session }: { session: Session }) {
  return (
    <section class="card today-open" aria-label={t("today.open")} data-testid="today-open">
      <div>
        <h2>{t("today.open")}</h2>
        <p>{session.patient_name}</p>
      </div>
      <a class="button primary big" href={hrefOf({ page: "live" })} data-testid="go-live">
        {t("session.go-on")}
      </a>
    </section>
  );
}

function Patients({ rows }: { rows: readonly PatientToday[] }) {
  const [sought, setSought] = useState("");
  const isSeeking = sought.trim() !== "";
  const due = rows.filter((row) => row.due);
  const others = isSeeking ? matching(rows, sought) : rows.filter((row) => !row.due);
  return (
    <>
      {!isSeeking && <Due rows={due} />}
      <section class="today-part">
        <div class="heading">
          <h2>{t(isSeeking || due.length === 0 ? "today.all" : "today.others")}</h2>
          <label class="today-search">
            {t("today.search")}
            <input
              type="search"
              value={sought}
              onInput={(event) => setSought(event.currentTarget.value)}
              data-testid="search-patient"
            />
          </label>
        </div>
        {isSeeking && others.length === 0 && <p class="card">{t("today.nobody", { name: sought })}</p>}
        <List rows={others} />
      </section>
    </>
  );
}

function Due({ rows }: { rows: readonly PatientToday[] }) {
  return (
    <section class="today-part" data-testid="due">
      <h2>{t("today.due", { count: rows.length })}</h2>
      {rows.length === 0 && <p class="soft">{t("today.due.none")}</p>}
      <List rows={rows} />
    </section>
  );
}

function List({ rows }: { rows: readonly PatientToday[] }) {
  return (
    <ul class="list">
      {rows.map((row) => (
        <li key={row.id}>
          <PatientRow row={row} />
        </li>
      ))}
    </ul>
  );
}
