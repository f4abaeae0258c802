// The last look before the arm may move: what still stands in the way, and the patient's screen.
import { t } from "../../strings";
import { sentence } from "../format";
import { useFromFeed } from "../live/feed";
import { PlayLink } from "../live/play-link";
import type { StepProps } from "./step-view";

export function ReadyStep({ feed, session }: StepProps) {
  const blockers = useFromFeed(feed, 4, ({ newest }) => newest?.tick.blockers.join("\n") ?? "");
  const screens = useFromFeed(feed, 2, ({ newest }) => newest?.session?.patient_screens ?? 0);
  if (!session) return <p>{t("wizard.ready.first")}</p>;
  return (
    <>
      {blockers ? <Blocked blockers={blockers.split("\n")} /> : <p class="wizard-fine">✓ {t("wizard.ready.press")}</p>}
      <p>{t(screens > 0 ? "wizard.ready.screen.there" : "wizard.ready.screen")}</p>
      <div class="row">
        <PlayLink />
      </div>
    </>
  );
}

function Blocked({ blockers }: { blockers: readonly string[] }) {
  return (
    <div class="notice">
      <span aria-hidden="true">⚠</span>
      <div>
        <strong>{t("wizard.ready.waits")}</strong>
        <ul>
          {blockers.map((one) => (
            <li key={one}>{sentence(one)}</li>
          ))}
        </ul>
      </div>
    </div>
  );
}
