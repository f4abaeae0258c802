// Who of several people is the patient, as said here: the station hears of it once a session is open.
import type { Person } from "../live/people";
import { bodyToChoose } from "../live/people";

/** A body as its sensor numbers it. */
export interface Choice {
  sensor: string;
  body: string;
}

/** The body by which the station is told of a person. */
export function choiceOf(person: Person): Choice | null {
  const body = bodyToChoose(person);
  return body ? { sensor: body.sensor, body: body.body } : null;
}

/** The people with that choice made; unchanged where the body has left the view. */
export function withChoice(people: readonly Person[], choice: Choice | null): readonly Person[] {
  const isChosen = ({ bodies }: Person) =>
    bodies.some(({ sensor, body }) => sensor === choice?.sensor && body === choice.body);
  if (!people.some(isChosen)) return people;
  return people.map((person) => ({ ...person, isPatient: isChosen(person), isConfirmed: isChosen(person) }));
}
