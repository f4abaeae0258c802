// How the exoskeleton helps this patient: the way a session begins with, and the most help there may be.
import { ASSISTANCE } from "../../api/types";
import { t } from "../../strings";
import { LevelSlider } from "../level-slider";
import type { PartProps } from "./form";

export function HelpFields({ draft, change }: PartProps) {
  return (
    <section class="card">
      <h2>{t("help.title")}</h2>
      <fieldset class="choices" aria-label={t("help.title")}>
        {ASSISTANCE.map((mode) => (
          <button
            key={mode}
            type="button"
            class="choice choice-low"
            aria-pressed={draft.assistance === mode}
            onClick={() => change({ assistance: mode })}
            data-testid={`begin-${mode}`}
          >
            {t(`help.${mode}`)}
          </button>
        ))}
      </fieldset>
      <p class="soft small">{t(`help.${draft.assistance}.means`)}</p>
      <div class="field">
        <span>{t("help.limit")}</span>
        <LevelSlider level={draft.most} most={1} disabled={false} onChange={(most) => change({ most })} />
      </div>
    </section>
  );
}
