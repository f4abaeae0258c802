// Back, on, and opening the session, with what is still missing for that.
import { t } from "../../strings";
import { type Facts, missing, STEPS, type Step } from "./steps";

interface Props {
  at: Step;
  facts: Facts;
  /** No session is open, of anybody. */
  isFree: boolean;
  busy: boolean;
  onGo: (step: Step) => void;
  onOpen: () => void;
}

/** Where the session can be opened. */
const OPENING: readonly Step[] = ["arm", "limits"];

export function Foot({ at, facts, isFree, busy, onGo, onOpen }: Props) {
  const opens = !facts.isOpen && OPENING.includes(at);
  const lacking = missing(facts);
  const before = STEPS[STEPS.indexOf(at) - 1];
  const next = nextOf(at, facts);
  return (
    <footer class="wizard-foot">
      {opens && lacking.length > 0 && <Missing at={at} lacking={lacking} onGo={onGo} />}
      <div class="row">
        {before && (
          <button type="button" onClick={() => onGo(before)} data-testid="wizard-back">
            ← {t("wizard.back")}
          </button>
        )}
        {next && (
          <button type="button" class={opens ? "" : "primary"} onClick={() => onGo(next)} data-testid="wizard-next">
            {t("wizard.next")} →
          </button>
        )}
        {opens && (
          <button
            type="button"
            class="primary big"
            disabled={busy || !isFree || lacking.length > 0}
            onClick={onOpen}
            data-testid="begin-session"
          >
            {t("session.open")}
          </button>
        )}
      </div>
    </footer>
  );
}

/** What comes after opening cannot be gone to before. */
function nextOf(at: Step, { isOpen }: Facts): Step | undefined {
  const next = STEPS[STEPS.indexOf(at) + 1];
  return next === "range" && !isOpen ? undefined : next;
}

interface MissingProps {
  at: Step;
  lacking: ReturnType<typeof missing>;
  onGo: (step: Step) => void;
}

function Missing({ at, lacking, onGo }: MissingProps) {
  return (
    <section class="notice" aria-label={t("prepare.missing")} data-testid="missing">
      <span aria-hidden="true">⚠</span>
      <ul class="wizard-missing">
        {lacking.map(({ step, words }) => (
          <li key={words}>
            <span>{t(words)}</span>
            {step !== at && (
              <button type="button" onClick={() => onGo(step)} data-testid={`missing-${step}`}>
                {t(`wizard.${step}`)}
              </button>
            )}
          </li>
        ))}
      </ul>
    </section>
  );
}
