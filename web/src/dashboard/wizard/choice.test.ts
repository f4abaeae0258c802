import { describe, expect, test } from "vitest";
import type { PersonView } from "../../api/types";
import type { Person } from "../live/people";
import { choiceOf, withChoice } from "./choice";

const seen = (sensor: string, body: string) => ({ sensor, body, is_patient: false }) as PersonView;
const PEOPLE: Person[] = [
  { label: "A", bodies: [seen("s", "1")], isPatient: true, isConfirmed: false, place: null },
  { label: "B", bodies: [seen("s", "2"), seen("r", "7")], isPatient: false, isConfirmed: false, place: null },
];

describe("a choice made before the session is open", () => {
  test("shows as made, of one person only", () => {
    const chosen = withChoice(PEOPLE, { sensor: "r", body: "7" });
    expect(chosen.map((person) => [person.isPatient, person.isConfirmed])).toEqual([
      [false, false],
      [true, true],
    ]);
  });

  test("lapses with the body that it named", () => {
    expect(withChoice(PEOPLE, { sensor: "s", body: "9" })).toBe(PEOPLE);
    expect(withChoice(PEOPLE, null)).toBe(PEOPLE);
  });

  test("names the person by a body of theirs", () => {
    expect(PEOPLE.map(choiceOf)).toEqual([
      { sensor: "s", body: "1" },
      { sensor: "s", body: "2" },
    ]);
  });
});
