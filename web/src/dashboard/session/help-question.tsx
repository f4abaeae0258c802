// How the exoskeleton helps at first; it can be changed at any time during the session.
import { ASSISTANCE, type Assistance } from "../../api/types";
import { t } from "../../strings";
import { LevelSlider } from "../level-slider";

interface Props {
  mode: Assistance;
  level: number;
  most: number;
  onMode: (mode: Assistance) => void;
  onLevel: (level: number) => void;
}

export function HelpQuestion({ mode, level, most, onMode, onLevel }: Props) {
  return (
    <section class="question">
      <h3>{t("help.title")}</h3>
      <div class="choices">
        {ASSISTANCE.map((one) => (
          <button
            key={one}
            type="button"
            class="choice choice-low"
            aria-pressed={mode === one}
            onClick={() => onMode(one)}
            data-testid={`begin-${one}`}
          >
            {t(`help.${one}`)}
          </button>
        ))}
      </div>
      <p class="soft small">{t(`help.${mode}.means`)}</p>
      {mode === "assisted" && <LevelSlider level={level} most={most} disabled={false} onChange={onLevel} />}
    </section>
  );
}
