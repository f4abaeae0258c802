// What is played in a session, in order: added, moved, taken out, and how hard each game is.
import { useRef } from "preact/hooks";
import { t } from "../../strings";
import { gameAim, gameName } from "../../strings/games";
import { NumberField, numberIn } from "../number-field";
import { type ExerciseDraft, exerciseDraft, MOST_EXERCISES, MOST_MINUTES, moved, WAYS, type Way } from "./draft";

const FIRST_MINUTES = 5;

interface Props {
  exercises: readonly ExerciseDraft[];
  games: readonly string[];
  onChange: (exercises: readonly ExerciseDraft[]) => void;
}

export function ExerciseFields({ exercises, games, onChange }: Props) {
  const heading = useRef<HTMLHeadingElement>(null);
  const replace = (index: number, part: Partial<ExerciseDraft>) =>
    onChange(exercises.map((one, at) => (at === index ? { ...one, ...part } : one)));
  const add = (game: string) => {
    const key = 1 + Math.max(-1, ...exercises.map((one) => one.key));
    onChange([...exercises, exerciseDraft(key, { game, minutes: FIRST_MINUTES, level: null, pinned: false })]);
  };
  const remove = (index: number) => {
    onChange(exercises.filter((_, at) => at !== index));
    heading.current?.focus(); // the button that was pressed goes with its row: the keyboard begins the list again
  };
  return (
    <section class="card">
      <h2 ref={heading} tabIndex={-1}>
        {t("plan.session")}
      </h2>
      {exercises.length === 0 && <p class="caveat">⚠ {t("plan.session.empty")}</p>}
      <ol class="plan-exercises">
        {exercises.map((exercise, index) => (
          <li key={exercise.key} class="plan-exercise" data-testid="plan-exercise" data-game={exercise.game}>
            <ExerciseRow
              number={index + 1}
              exercise={exercise}
              onChange={(part) => replace(index, part)}
              onMove={(by) => onChange(moved(exercises, index, by))}
              isLast={index === exercises.length - 1}
              onRemove={() => remove(index)}
            />
          </li>
        ))}
      </ol>
      {exercises.length < MOST_EXERCISES && <AddGame games={games} onAdd={add} />}
    </section>
  );
}

interface RowProps {
  number: number;
  exercise: ExerciseDraft;
  isLast: boolean;
  onChange: (part: Partial<ExerciseDraft>) => void;
  onMove: (by: -1 | 1) => void;
  onRemove: () => void;
}

function ExerciseRow({ number, exercise, isLast, onChange, onMove, onRemove }: RowProps) {
  const name = gameName(exercise.game);
  const isWrong = numberIn(exercise.minutes, 0.5, MOST_MINUTES) === null;
  return (
    <>
      <div class="plan-game">
        <h3>
          {number}. {name}
        </h3>
        <span class="hint">{gameAim(exercise.game)}</span>
      </div>
      <NumberField
        name={t("plan.minutes")}
        min={0.5}
        max={MOST_MINUTES}
        step="0.5"
        value={exercise.minutes}
        wrong={isWrong ? t("plan.between", { least: 0.5, most: MOST_MINUTES }) : ""}
        onInput={(minutes) => onChange({ minutes })}
        testId="plan-minutes"
      />
      <Difficulty exercise={exercise} onChange={onChange} />
      <div class="plan-moves">
        <Move sign="↑" name={t("plan.up", { name })} disabled={number === 1} onClick={() => onMove(-1)} />
        <Move sign="↓" name={t("plan.down", { name })} disabled={isLast} onClick={() => onMove(1)} />
        <Move sign="✕" name={t("plan.remove", { name })} disabled={false} onClick={onRemove} />
      </div>
    </>
  );
}

function Difficulty({ exercise, onChange }: Pick<RowProps, "exercise" | "onChange">) {
  return (
    <div class="plan-difficulty">
      <label>
        {t("plan.difficulty")}
        <select
          value={exercise.way}
          onChange={(event) => onChange({ way: event.currentTarget.value as Way })}
          data-testid="plan-way"
        >
          {WAYS.map((way) => (
            <option key={way} value={way}>
              {t(`plan.difficulty.${way}`)}
            </option>
          ))}
        </select>
      </label>
      {exercise.way !== "adapts" && (
        <NumberField
          name={t("plan.level")}
          unit="%"
          min={0}
          max={100}
          step="5"
          value={exercise.level}
          wrong={numberIn(exercise.level, 0, 100) === null ? t("plan.between", { least: 0, most: 100 }) : ""}
          onInput={(level) => onChange({ level })}
          testId="plan-level"
        />
      )}
    </div>
  );
}

interface MoveProps {
  sign: string;
  name: string;
  disabled: boolean;
  onClick: () => void;
}

function Move({ sign, name, disabled, onClick }: MoveProps) {
  return (
    <button type="button" aria-label={name} title={name} disabled={disabled} onClick={onClick}>
      {sign}
    </button>
  );
}

function AddGame({ games, onAdd }: { games: readonly string[]; onAdd: (game: string) => void }) {
  return (
    <div class="field">
      <span id="add-game">{t("plan.add")}</span>
      <fieldset class="plan-games" aria-labelledby="add-game">
        {games.map((game) => (
          <button key={game} type="button" class="plan-add" onClick={() => onAdd(game)} data-testid={`add-${game}`}>
            <span>+ {gameName(game)}</span>
            <span class="hint">{gameAim(game)}</span>
          </button>
        ))}
      </fieldset>
    </div>
  );
}
