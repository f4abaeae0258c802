// The connection is lost: what the arm does now and what to do, large, over everything that is no longer true.
import { t } from "../../strings";
import type { Charge } from "./charge";
import { StateSign } from "./state-sign";
import "./lost.css";

export function Lost({ charge }: { charge: Charge }) {
  return (
    <div class="lost" role="alert" data-testid="lost">
      <div class="card">
        <StateSign state="lost" />
        <strong>{t(charge === "other" ? "lost.other" : "lost.held")}</strong>
        <p>{t("lost.look")}</p>
        <p class="soft">{t("lost.trying")}</p>
      </div>
    </div>
  );
}
