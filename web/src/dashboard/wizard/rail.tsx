// All steps with how they stand; each can be gone to at any time.
import { t } from "../../strings";
import { type Facts, type Mark, STEPS, type Step, standingOf } from "./steps";

/** What is still to come shows its number. */
const SIGNS: Record<Mark, string> = { done: "✓", busy: "…", look: "!", open: "" };

interface Props {
  facts: Facts;
  at: Step;
  onGo: (step: Step) => void;
}

export function Rail({ facts, at, onGo }: Props) {
  return (
    <nav class="wizard-rail" aria-label={t("wizard.steps")}>
      <ol>
        {STEPS.map((step) => (
          <li key={step}>
            <Entry step={step} facts={facts} isHere={step === at} onGo={() => onGo(step)} />
          </li>
        ))}
      </ol>
    </nav>
  );
}

interface EntryProps {
  step: Step;
  facts: Facts;
  isHere: boolean;
  onGo: () => void;
}

function Entry({ step, facts, isHere, onGo }: EntryProps) {
  const { mark, words, values } = standingOf(step, facts);
  return (
    <button
      type="button"
      aria-current={isHere ? "step" : undefined}
      class={`wizard-entry wizard-${mark}`}
      onClick={onGo}
      data-testid={`step-${step}`}
      data-mark={mark}
    >
      <span class="wizard-sign" aria-hidden="true">
        {SIGNS[mark] || STEPS.indexOf(step) + 1}
      </span>
      <span class="wizard-name">{t(`wizard.${step}`)}</span>
      <span class="wizard-words small">{t(words, values)}</span>
    </button>
  );
}
