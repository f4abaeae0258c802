// The most help that may be given, in steps of ten percent: by a slider, by two buttons, by the arrow keys.
import { useEffect, useState } from "preact/hooks";
import { t } from "../strings";
import "./level-slider.css";

const STEP = 10;

interface Props {
  /** 0..1, as the station has it. */
  level: number;
  /** 0..1, the patient's own limit. */
  most: number;
  disabled: boolean;
  onChange: (level: number) => void;
}

export function LevelSlider({ level, most, disabled, onChange }: Props) {
  const [percent, setPercent] = useState(Math.round(100 * level));
  // What the station says counts; between dragging and its answer the page shows what was wished.
  useEffect(() => setPercent(Math.round(100 * level)), [level]);
  const limit = Math.round(100 * most);
  const choose = (next: number) => {
    const kept = Math.min(limit, Math.max(0, next));
    setPercent(kept);
    onChange(kept / 100);
  };
  return (
    <div class="level">
      <Step sign="−" name={t("help.less")} disabled={disabled || percent <= 0} onClick={() => choose(percent - STEP)} />
      <input
        type="range"
        min={0}
        max={100}
        step={STEP}
        value={percent}
        disabled={disabled}
        aria-label={t("help.level")}
        aria-valuetext={`${percent} %`}
        onInput={(event) => setPercent(Math.min(limit, Number(event.currentTarget.value)))}
        onChange={(event) => choose(Number(event.currentTarget.value))}
        data-testid="help-level"
      />
      <Step
        sign="+"
        name={t("help.more")}
        disabled={disabled || percent >= limit}
        onClick={() => choose(percent + STEP)}
      />
      <output class="number">
        {percent} %{limit < 100 && <span class="small soft"> {t("help.most", { limit })}</span>}
      </output>
    </div>
  );
}

interface StepProps {
  sign: string;
  name: string;
  disabled: boolean;
  onClick: () => void;
}

function Step({ sign, name, disabled, onClick }: StepProps) {
  return (
    <button type="button" aria-label={name} disabled={disabled} onClick={onClick}>
      {sign}
    </button>
  );
}
