// Where one goes on from a session: to watch it again, to its report, to the patient.
import type { SessionDetail } from "../../api/types";
import { t } from "../../strings";
import { hrefOf } from "../route";

export function SessionLinks({ session }: { session: SessionDetail }) {
  return (
    <div class="row">
      {session.status !== "open" && (
        <>
          <a class="button" href={hrefOf({ page: "replay", id: session.id })} data-testid="open-replay">
            {t("replay.open")}
          </a>
          <a class="button" href={hrefOf({ page: "session-report", id: session.id })} data-testid="open-report">
            {t("report.open")}
          </a>
        </>
      )}
      <a class="button" href={hrefOf({ page: "patient", id: session.patient_id })} data-testid="back-to-patient">
        {t("summary.back")}
      </a>
      {session.status !== "open" && (
        <a class="button primary" href={hrefOf({ page: "prepare", id: session.patient_id })} data-testid="next-session">
          {t("summary.next")}
        </a>
      )}
    </div>
  );
}
