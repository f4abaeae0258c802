import { describe, expect, test } from "vitest";
import type { SensorView } from "../../api/types";
import type { Person } from "../live/people";
import { type Facts, firstToDo, missing, standingOf } from "./steps";

const sensor = (about: Partial<SensorView> = {}) =>
  ({ sensor: "a", age_s: 0, aligned: true, residual_m: 0.01, ...about }) as SensorView;
const person = (about: Partial<Person> = {}): Person => ({
  label: "A",
  bodies: [],
  isPatient: true,
  isConfirmed: false,
  place: null,
  ...about,
});

const READY: Facts = {
  isConnected: true,
  sensors: [sensor(), sensor({ sensor: "b" })],
  people: [person()],
  confirmedSide: "left",
  affectedSide: "left",
  areLimitsSigned: true,
  isOpen: true,
  isRangeTaken: true,
  mayStart: true,
};
const markOf = (step: Parameters<typeof standingOf>[0], about: Partial<Facts>) =>
  standingOf(step, { ...READY, ...about }).mark;

describe("a step", () => {
  test("asks for a person where sensors are silent, nobody or several are in view, or the sensors disagree", () => {
    expect(markOf("sensors", { sensors: [] })).toBe("look");
    expect(markOf("sensors", { sensors: [sensor(), sensor({ age_s: 9 })] })).toBe("look");
    expect(markOf("person", { people: [] })).toBe("look");
    expect(markOf("person", { people: [person(), person({ label: "B" })] })).toBe("look");
    expect(markOf("alignment", { sensors: [sensor(), sensor({ residual_m: 0.2 })] })).toBe("look");
  });

  test("is done by a choice among several people", () => {
    expect(markOf("person", { people: [person({ isConfirmed: true }), person({ label: "B" })] })).toBe("done");
  });

  test("says nothing of sensors and people while the stream is not there", () => {
    const lost = { isConnected: false, sensors: [], people: [] };
    for (const step of ["sensors", "person", "alignment"] as const) expect(markOf(step, lost)).toBe("busy");
  });

  test("of alignment gets there by itself, and needs nothing of a single sensor", () => {
    expect(markOf("alignment", { sensors: [sensor(), sensor({ aligned: false })] })).toBe("busy");
    expect(markOf("alignment", { sensors: [sensor()] })).toBe("done");
  });
});

describe("the first thing to do", () => {
  test("is what a person must see to; nothing waits for the alignment", () => {
    const aligning = [sensor(), sensor({ aligned: false })];
    expect(firstToDo({ ...READY, sensors: aligning, confirmedSide: null, isOpen: false })).toBe("arm");
    expect(firstToDo({ ...READY, sensors: [] })).toBe("sensors");
    expect(firstToDo(READY)).toBe("ready");
  });
});

describe("what is missing", () => {
  test("is named with the step that puts it right", () => {
    expect(missing({ ...READY, confirmedSide: null, areLimitsSigned: false }).map(({ step }) => step)).toEqual([
      "arm",
      "limits",
    ]);
    expect(missing({ ...READY, confirmedSide: "right" }).map(({ step }) => step)).toEqual(["arm"]);
    expect(missing({ ...READY, people: [person(), person({ label: "B" })] }).map(({ step }) => step)).toEqual([
      "person",
    ]);
  });

  test("does not count what can come later: without sensors a session can be opened", () => {
    expect(missing({ ...READY, sensors: [], people: [] })).toEqual([]);
  });
});
