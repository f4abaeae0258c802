import { expect, test } from "vitest";
import type { PersonView } from "../../api/types";
import { bodyToChoose, isOpenQuestion, peopleOf } from "./people";

const seen = (sensor: string, body: string, x: number | null, more: Partial<PersonView> = {}): PersonView => ({
  sensor,
  body,
  place_in_sensor: [0, 0, 2],
  place_in_room: x === null ? null : [x, 0.3, 2],
  is_patient: false,
  confirmed: false,
  reason: "another person: seen beside the patient",
  ...more,
});
const PATIENT = { is_patient: true, reason: "the patient" };

test("bodies of two sensors at one place are one person, the patient first", () => {
  const people = peopleOf([
    seen("a", "1", 1.2),
    seen("a", "2", 0, PATIENT),
    seen("b", "7", 0.2, PATIENT),
    seen("b", "8", 1.1),
  ]);
  expect(people.map(({ label, bodies }) => [label, bodies.map(({ body }) => body)])).toEqual([
    ["A", ["2", "7"]],
    ["B", ["1", "8"]],
  ]);
  expect(people[0]?.isPatient).toBe(true);
  expect(people[0]?.place).toEqual([0, 2]);
});

test("two bodies of one sensor are two people, however near", () => {
  expect(peopleOf([seen("a", "1", 0), seen("a", "2", 0.1)])).toHaveLength(2);
});

test("a sensor whose place is not known shows people of its own, but its patient is the patient", () => {
  const people = peopleOf([seen("a", "1", 0, PATIENT), seen("b", "5", null), seen("b", "6", null, PATIENT)]);
  expect(people.map(({ bodies }) => bodies.length)).toEqual([2, 1]);
});

test("it is asked who the patient is while several are in view and nobody has said it", () => {
  const two = [seen("a", "1", 0, PATIENT), seen("a", "2", 1)];
  expect(isOpenQuestion(peopleOf(two.slice(0, 1)))).toBe(false);
  expect(isOpenQuestion(peopleOf(two))).toBe(true);
  expect(isOpenQuestion(peopleOf([seen("a", "1", 0, { ...PATIENT, confirmed: true }), seen("a", "2", 1)]))).toBe(false);
});

test("the body named is the followed one, else the first", () => {
  const [patient, other] = peopleOf([
    seen("a", "1", 0, { reason: "nobody is followed yet" }),
    seen("b", "2", 0.1, PATIENT),
    seen("b", "3", 2),
  ]);
  expect(patient && bodyToChoose(patient)?.body).toBe("2");
  expect(other && bodyToChoose(other)?.body).toBe("3");
});
