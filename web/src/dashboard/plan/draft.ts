// A plan as the form holds it: text, until it can be sent.
import type { Exercise, Plan, PlanForm } from "../../api/types";
import { dayOf, isoDay } from "../format";
import { numberIn, wholeIn } from "../number-field";

/** The difficulty follows the patient, follows from a level on, or stays. */
export const WAYS = ["adapts", "from", "stays"] as const;
export type Way = (typeof WAYS)[number];

export interface ExerciseDraft {
  /** Tells the rows of a form apart, whatever their order. */
  key: number;
  game: string;
  minutes: string;
  way: Way;
  /** Percent. */
  level: string;
}

export interface PlanDraft {
  exercises: readonly ExerciseDraft[];
  repetitions: string;
  perWeek: string;
  weeks: string;
  startsOn: string;
  note: string;
}

export const MOST_MINUTES = 60;
export const MOST_PER_WEEK = 14;
export const MOST_WEEKS = 52;
export const MOST_REPETITIONS = 2000;
export const MOST_EXERCISES = 12;
const DAYS = 7;

export function newDraft(today: Date): PlanDraft {
  return {
    exercises: [exerciseDraft(0, { game: "reach", minutes: 6, level: null, pinned: false })],
    repetitions: "",
    perWeek: "3",
    weeks: "4",
    startsOn: isoDay(today),
    note: "",
  };
}

export function draftOf(plan: Plan): PlanDraft {
  return {
    exercises: plan.exercises.map((exercise, key) => exerciseDraft(key, exercise)),
    repetitions: plan.repetitions ? String(plan.repetitions) : "",
    perWeek: String(plan.sessions_per_week),
    weeks: String(plan.weeks),
    startsOn: plan.starts_on,
    note: plan.note,
  };
}

export function exerciseDraft(key: number, { game, minutes, level, pinned }: Exercise): ExerciseDraft {
  const way = pinned ? "stays" : level === null || level === undefined ? "adapts" : "from";
  return { key, game, minutes: String(minutes), way, level: String(Math.round(100 * (level ?? 0.3))) };
}

/** What is sent, or null while something is missing or does not make sense. */
export function formOf(draft: PlanDraft): PlanForm | null {
  const exercises = draft.exercises.map(exerciseOf);
  const perWeek = wholeIn(draft.perWeek, 1, MOST_PER_WEEK);
  const weeks = wholeIn(draft.weeks, 1, MOST_WEEKS);
  const repetitions = repetitionsOf(draft);
  if (exercises.length === 0 || exercises.includes(null) || !perWeek || !weeks) return null;
  if (repetitions === undefined || !draft.startsOn) return null;
  return {
    exercises: exercises as Exercise[], // none is null, as was just seen
    repetitions,
    sessions_per_week: perWeek,
    weeks,
    starts_on: draft.startsOn,
    note: draft.note,
  };
}

function exerciseOf({ game, minutes, way, level }: ExerciseDraft): Exercise | null {
  const played = numberIn(minutes, 0.5, MOST_MINUTES);
  const percent = numberIn(level, 0, 100);
  if (played === null || percent === null) return null;
  return { game, minutes: played, level: way === "adapts" ? null : percent / 100, pinned: way === "stays" };
}

/** Null = none is aimed for; undefined = what was typed is no number of attempts. */
export function repetitionsOf({ repetitions }: Pick<PlanDraft, "repetitions">): number | null | undefined {
  if (repetitions.trim() === "") return null;
  return wholeIn(repetitions, 1, MOST_REPETITIONS) ?? undefined;
}

export interface Sum {
  sessions: number;
  minutes: number;
  lastDay: Date;
}

/** What a plan comes to. */
export function sumOf({ exercises, sessions_per_week, weeks, starts_on }: PlanForm): Sum {
  const lastDay = dayOf(starts_on);
  lastDay.setDate(lastDay.getDate() + DAYS * weeks - 1);
  return {
    sessions: sessions_per_week * weeks,
    minutes: exercises.reduce((all, { minutes }) => all + minutes, 0),
    lastDay,
  };
}

/** The exercises with one moved up (−1) or down (+1). */
export function moved(exercises: readonly ExerciseDraft[], index: number, by: -1 | 1): readonly ExerciseDraft[] {
  const order = [...exercises];
  const [taken] = order.splice(index, 1);
  if (taken) order.splice(index + by, 0, taken);
  return order;
}
