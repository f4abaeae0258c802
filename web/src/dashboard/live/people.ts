// The people in view, each with every sensor's body of them.
import type { PersonView } from "../../api/types";

export interface Person {
  /** A letter, the same as long as the same bodies are in view. */
  label: string;
  /** One body for each sensor that sees this person. */
  bodies: PersonView[];
  isPatient: boolean;
  /** Whether somebody said that this is the patient. */
  isConfirmed: boolean;
  /** To the right and away from the reference sensor, m; null where no sensor's place is known. */
  place: readonly [number, number] | null;
}

/** Bodies of two sensors that are nearer to one another than this are one person's. */
const TOGETHER_M = 0.5;

/** Who is there: the patient first, then the others, each with a letter. */
export function peopleOf(bodies: readonly PersonView[]): Person[] {
  const ordered = [...bodies].sort((a, b) => Number(b.is_patient) - Number(a.is_patient) || order(a, b));
  const groups: PersonView[][] = [];
  for (const body of ordered) {
    const own = groups.find((group) => belongs(body, group));
    if (own) own.push(body);
    else groups.push([body]);
  }
  return groups.map((group, index) => personOf(group, String.fromCharCode(65 + index)));
}

/** Whether a person must say who the patient is: several are in view, and nobody has said it. */
export function isOpenQuestion(people: readonly Person[]): boolean {
  return people.length > 1 && !people.some((person) => person.isConfirmed);
}

/** The body to name when this person is chosen: the one that was confirmed or is followed, else the first. */
export function bodyToChoose(person: Person): PersonView | undefined {
  return person.bodies.find((body) => body.is_patient) ?? person.bodies[0];
}

function order(a: PersonView, b: PersonView): number {
  return `${a.sensor} ${a.body}`.localeCompare(`${b.sensor} ${b.body}`);
}

function belongs(body: PersonView, group: readonly PersonView[]): boolean {
  if (group.some((other) => other.sensor === body.sensor)) return false;
  if (body.is_patient && group[0]?.is_patient) return true;
  return group.some((other) => apart_m(body, other) < TOGETHER_M);
}

function apart_m(a: PersonView, b: PersonView): number {
  if (!a.place_in_room || !b.place_in_room) return Number.POSITIVE_INFINITY;
  return Math.hypot(a.place_in_room[0] - b.place_in_room[0], a.place_in_room[2] - b.place_in_room[2]);
}

function personOf(bodies: PersonView[], label: string): Person {
  const place = bodies.find((body) => body.place_in_room)?.place_in_room;
  return {
    label,
    bodies,
    isPatient: bodies.some((body) => body.is_patient),
    isConfirmed: bodies.some((body) => body.confirmed),
    place: place ? [place[0], place[2]] : null,
  };
}
