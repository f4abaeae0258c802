// A number that a person types, with what it is, in which unit, and what is wrong with it.
interface Props {
  name: string;
  value: string;
  min: number;
  max: number;
  step?: string;
  unit?: string;
  /** In plain words, or empty. */
  wrong?: string;
  required?: boolean;
  onInput: (value: string) => void;
  testId: string;
}

export function NumberField({ name, value, min, max, step = "1", unit, wrong, required, onInput, testId }: Props) {
  return (
    <label class="number-field">
      <span>{name}</span>
      <span class="number-field-value">
        <input
          type="number"
          min={min}
          max={max}
          step={step}
          value={value}
          required={required}
          aria-invalid={wrong ? true : undefined}
          onInput={(event) => onInput(event.currentTarget.value)}
          data-testid={testId}
        />
        {unit && <span class="hint">{unit}</span>}
      </span>
      {wrong && <span class="small caveat">⚠ {wrong}</span>}
    </label>
  );
}

/** The number that was typed, or null where it is none between `min` and `max`. */
export function numberIn(text: string, min: number, max: number): number | null {
  const value = Number(text);
  return text.trim() !== "" && Number.isFinite(value) && value >= min && value <= max ? value : null;
}

/** The same, of whole numbers only. */
export function wholeIn(text: string, min: number, max: number): number | null {
  const value = numberIn(text, min, max);
  return value !== null && Number.isInteger(value) ? value : null;
}
