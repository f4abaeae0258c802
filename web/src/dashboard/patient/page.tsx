// One patient: who, how far the arm may go, and what the sessions have shown.
import { currentSession, readHistory, readPatient } from "../../api/client";
import { otherSide, type Patient } from "../../api/types";
import { t } from "../../strings";
import { useAsked } from "../hooks";
import { ProblemBox } from "../problem";
import { hrefOf } from "../route";
import { History } from "./history";
import { LimitsCard } from "./limits-card";
import { PlanCard } from "./plan-card";
import { PatientTabs } from "./tabs";

export function PatientPage({ id }: { id: number }) {
  const patient = useAsked(() => readPatient(id), id);
  const sessions = useAsked(() => readHistory(id), id);
  return (
    <main class="page">
      <ProblemBox problem={patient.problem ?? sessions.problem} onRetry={patient.again} />
      {patient.value && <Head patient={patient.value} />}
      <PatientTabs id={id} at="patient" />
      {patient.value && !patient.value.limits_set_by && (
        <LimitsCard patient={patient.value} onConfirmed={patient.again} />
      )}
      <PlanCard id={id} />
      {sessions.value && (
        <section class="card">
          <h2>{t("history.title")}</h2>
          {sessions.value.length === 0 ? (
            <p class="soft">{t("history.none")}</p>
          ) : (
            <History sessions={sessions.value} />
          )}
        </section>
      )}
      {patient.value && <Known patient={patient.value} onConfirmed={patient.again} />}
    </main>
  );
}

function Head({ patient }: { patient: Patient }) {
  return (
    <div class="heading">
      <div>
        <h1>{patient.name}</h1>
        <p>{t(`patient.affected.${otherSide(patient.healthy_side)}`)}</p>
      </div>
      <div class="row">
        <a class="button" href={hrefOf({ page: "change-patient", id: patient.id })} data-testid="change-patient">
          {t("action.change")}
        </a>
        <OpenButton patient={patient} />
      </div>
    </div>
  );
}

/** Leads to the open session where this patient has one, else to the preparation of a new one. */
function OpenButton({ patient }: { patient: Patient }) {
  const current = useAsked(currentSession, patient.id);
  if (current.value?.patient_id === patient.id) {
    return (
      <a class="button primary big" href={hrefOf({ page: "live" })} data-testid="go-live">
        {t("session.go-on")}
      </a>
    );
  }
  return (
    <a class="button primary big" href={hrefOf({ page: "prepare", id: patient.id })} data-testid="open-session">
      {t("session.open")}
    </a>
  );
}

function Known({ patient, onConfirmed }: { patient: Patient; onConfirmed: () => void }) {
  return (
    <div class="columns">
      <section class="card">
        <h2>{t("patient.notes")}</h2>
        <p class="notes">{patient.notes || <span class="soft">{t("patient.notes.none")}</span>}</p>
      </section>
      {patient.limits_set_by && <LimitsCard patient={patient} onConfirmed={onConfirmed} />}
    </div>
  );
}
