// What this patient's arm may do, and who has signed for it: without that, no session can be opened.
import { confirmLimits } from "../../api/client";
import { JOINTS, type Joint, type Patient, type PatientLimits } from "../../api/types";
import { t } from "../../strings";
import { angleText, dateAndTime, figure } from "../format";
import { useDoing } from "../hooks";
import { ProblemBox } from "../problem";

interface Props {
  patient: Patient;
  onConfirmed: () => void;
}

export function LimitsCard({ patient, onConfirmed }: Props) {
  return (
    <section class="card" data-testid="limits" data-signed={patient.limits_set_by !== ""}>
      <h2>{t("limits.title")}</h2>
      <div class="table-scroll">
        <table>
          <thead>
            <tr>
              <th>{t("exo.joint")}</th>
              <th class="number">{t("range.title")}</th>
              <th class="number">{t("force.torque")}</th>
              <th class="number">{t("force.resistance")}</th>
            </tr>
          </thead>
          <tbody>
            {JOINTS.map((joint) => (
              <JointLimits key={joint} patient={patient} joint={joint} />
            ))}
          </tbody>
        </table>
      </div>
      <p>{t("limits.help", { mode: t(`help.${patient.assistance ?? "passive"}`), most: percent(patient) })}</p>
      {patient.limits_set_by ? <Signed patient={patient} /> : <Unsigned patient={patient} onConfirmed={onConfirmed} />}
    </section>
  );
}

function JointLimits({ patient, joint }: { patient: Patient; joint: Joint }) {
  const range = patient.passive_range?.[joint];
  const force = patient.force_limits?.[joint];
  return (
    <tr>
      <th scope="row">{t(`joint.${joint}`)}</th>
      <td class="number">{t("range.between", { min: angleText(range?.min_rad), max: angleText(range?.max_rad) })}</td>
      <td class="number">{figure(force?.torque_nm, 1)}</td>
      <td class="number">{figure(force?.resistance_nm, 1)}</td>
    </tr>
  );
}

function Signed({ patient }: { patient: Patient }) {
  return (
    <p data-testid="limits-signed">
      ✓ {t("limits.signed", { name: patient.limits_set_by, when: dateAndTime(patient.limits_set_at ?? undefined) })}
    </p>
  );
}

function Unsigned({ patient, onConfirmed }: Props) {
  const doing = useDoing();
  const confirm = () =>
    doing.run(async () => {
      await confirmLimits(patient.id, seenOf(patient));
      onConfirmed();
    });
  return (
    <>
      <p class="notice">⚠ {t("limits.unsigned")}</p>
      <ProblemBox problem={doing.problem} onRetry={onConfirmed} />
      <div class="row">
        <button type="button" class="primary big" disabled={doing.busy} onClick={confirm} data-testid="confirm-limits">
          {t("limits.confirm")}
        </button>
      </div>
    </>
  );
}

/** Exactly what stands on the page, so that nobody signs for what they have not seen. */
function seenOf({ passive_range, force_limits, assist_level_most }: Patient): PatientLimits {
  // always there in an answer; the schema calls optional whatever has a default
  return { passive_range, force_limits, assist_level_most } as PatientLimits;
}

function percent({ assist_level_most }: Patient): string {
  return figure(100 * (assist_level_most ?? 1));
}
