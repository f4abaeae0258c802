// Pain from 0 to 10, on big buttons; may be left out.
import { t } from "../../strings";

const LEVELS = Array.from({ length: 11 }, (_, level) => level);

interface Props {
  value: number | null;
  onChange: (value: number | null) => void;
}

export function PainScale({ value, onChange }: Props) {
  return (
    <div class="scale-place">
      <fieldset class="scale" aria-label={t("pain.label")}>
        {LEVELS.map((level) => (
          <button
            key={level}
            type="button"
            aria-pressed={value === level}
            onClick={() => onChange(value === level ? null : level)}
            data-testid={`pain-${level}`}
          >
            {level}
          </button>
        ))}
      </fieldset>
      <div class="scale-ends small soft">
        <span>{t("pain.none")}</span>
        <span>{t("pain.worst")}</span>
      </div>
    </div>
  );
}
