// The exercises of one session: which game, for how long, in which order.
import type { Exercise } from "../../api/types";
import { t } from "../../strings";
import { gameName } from "../../strings/games";
import "./programme.css";

const LEAST_MIN = 1;
const MOST_MIN = 60;
const USUAL_MIN = 6;
/** The service refuses more. */
const MOST_EXERCISES = 12;

interface Props {
  games: readonly string[];
  exercises: readonly Exercise[];
  onChange: (exercises: Exercise[]) => void;
}

export function Programme({ games, exercises, onChange }: Props) {
  const put = (index: number, given: Partial<Exercise>) =>
    onChange(exercises.map((one, place) => (place === index ? { ...one, ...given } : one)));
  const drop = (index: number) => onChange(exercises.filter((_, place) => place !== index));
  const first = games[0];
  return (
    <div class="programme">
      <ol>
        {exercises.map((exercise, index) => (
          <li key={index} data-testid="exercise" data-game={exercise.game}>
            <Row
              exercise={exercise}
              games={games}
              onChange={(given) => put(index, given)}
              onDrop={exercises.length > 1 ? () => drop(index) : null}
            />
          </li>
        ))}
      </ol>
      {first && exercises.length < MOST_EXERCISES && (
        <button
          type="button"
          onClick={() => onChange([...exercises, { game: first, minutes: USUAL_MIN, level: null, pinned: false }])}
          data-testid="add-exercise"
        >
          + {t("programme.add")}
        </button>
      )}
    </div>
  );
}

interface RowProps {
  exercise: Exercise;
  games: readonly string[];
  onChange: (given: Partial<Exercise>) => void;
  /** Null for the only exercise: a session without one is none. */
  onDrop: (() => void) | null;
}

function Row({ exercise: { game, minutes }, games, onChange, onDrop }: RowProps) {
  const known = games.includes(game) ? games : [game, ...games];
  const choose = (wanted: number) => onChange({ minutes: Math.min(MOST_MIN, Math.max(LEAST_MIN, wanted)) });
  return (
    <>
      <select
        value={game}
        aria-label={t("programme.game")}
        onChange={(event) => onChange({ game: event.currentTarget.value, level: null })}
      >
        {known.map((one) => (
          <option key={one} value={one}>
            {gameName(one)}
          </option>
        ))}
      </select>
      <button type="button" aria-label={t("programme.less")} onClick={() => choose(minutes - 1)}>
        −
      </button>
      <output>{t("programme.minutes", { minutes })}</output>
      <button type="button" aria-label={t("programme.more")} onClick={() => choose(minutes + 1)}>
        +
      </button>
      <button
        type="button"
        class="quiet"
        disabled={!onDrop}
        aria-label={t("programme.drop", { game: gameName(game) })}
        onClick={() => onDrop?.()}
      >
        ✕
      </button>
    </>
  );
}
