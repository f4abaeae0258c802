// The list of patients.
import { listPatients } from "../api/client";
import { otherSide, type Patient } from "../api/types";
import { t } from "../strings";
import { useAsked } from "./hooks";
import { ProblemBox } from "./problem";
import { hrefOf } from "./route";

export function PatientList() {
  const patients = useAsked(listPatients, "patients");
  return (
    <main class="page">
      <div class="heading">
        <h1>{t("patients.title")}</h1>
        <a class="button primary" href={hrefOf({ page: "enrol" })} data-testid="new-patient">
          {t("patients.new")}
        </a>
      </div>
      <ProblemBox problem={patients.problem} onRetry={patients.again} />
      {patients.value?.length === 0 && <p class="card">{t("patients.none")}</p>}
      <ul class="list">
        {patients.value?.map((patient) => (
          <li key={patient.id}>
            <PatientLink patient={patient} />
          </li>
        ))}
      </ul>
    </main>
  );
}

function PatientLink({ patient }: { patient: Patient }) {
  return (
    <a class="list-link" href={hrefOf({ page: "patient", id: patient.id })} data-testid="patient">
      <strong>{patient.name}</strong>
      <span>{t(`patient.affected.${otherSide(patient.healthy_side)}`)}</span>
    </a>
  );
}
