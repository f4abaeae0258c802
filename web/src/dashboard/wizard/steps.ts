// The steps from "who is there" to "ready", and how each of them stands. Nothing moves in any of them.
import type { SensorView, Side } from "../../api/types";
import type { Key } from "../../strings";
import { isOpenQuestion, type Person } from "../live/people";
import { isSilent } from "../live/silent";

/** In order; the session is opened after `limits`. */
export const STEPS = ["sensors", "person", "alignment", "arm", "limits", "range", "ready"] as const;
export type Step = (typeof STEPS)[number];

/** What the wizard goes by: what the stream shows, and what the therapist has answered. */
export interface Facts {
  /** Without the stream nothing is known of sensors and people. */
  isConnected: boolean;
  sensors: readonly SensorView[];
  /** With the therapist's choice among them, also where the station has not heard of it yet. */
  people: readonly Person[];
  confirmedSide: Side | null;
  affectedSide: Side;
  areLimitsSigned: boolean;
  isOpen: boolean;
  isRangeTaken: boolean;
  mayStart: boolean;
}

/** `look`: a person must do something; `busy`: it gets there by itself; `open`: to be answered, or not yet its turn. */
export type Mark = "done" | "busy" | "look" | "open";

export interface Standing {
  mark: Mark;
  /** In a few words, for the list of steps. */
  words: Key;
  values: Record<string, string | number>;
}

/** Aligned, yet further from the reference's body than this: about the width of a wrist. */
export const LARGE_RESIDUAL_M = 0.08;

export function standingOf(step: Step, facts: Facts): Standing {
  return JUDGES[step](facts);
}

/** The step that needs a person first; what gets there by itself is not waited for. */
export function firstToDo(facts: Facts): Step {
  return STEPS.find((step) => ["look", "open"].includes(standingOf(step, facts).mark)) ?? "ready";
}

/** Sensors that send now. */
export function sending(sensors: readonly SensorView[]): SensorView[] {
  return sensors.filter((sensor) => !isSilent(sensor));
}

/** Sensors that see the patient at another place than the reference does. */
export function farApart(sensors: readonly SensorView[]): SensorView[] {
  return sensors.filter((sensor) => sensor.aligned && (sensor.residual_m ?? 0) > LARGE_RESIDUAL_M);
}

const UNKNOWN: Standing = { mark: "busy", words: "wizard.unknown", values: {} };

const JUDGES: Record<Step, (facts: Facts) => Standing> = {
  sensors: ({ sensors, isConnected }) => {
    if (!isConnected) return UNKNOWN;
    const count = sending(sensors).length;
    if (count === 0) return standing("look", "wizard.sensors.none");
    return count < sensors.length
      ? standing("look", "wizard.sensors.silent", { count: sensors.length - count })
      : standing("done", "wizard.sensors.done", { count });
  },
  person: ({ people, isConnected }) => {
    if (!isConnected) return UNKNOWN;
    if (people.length === 0) return standing("look", "wizard.person.none");
    if (people.some((person) => person.isConfirmed)) return standing("done", "wizard.person.chosen");
    return isOpenQuestion(people)
      ? standing("look", "wizard.person.several", { count: people.length })
      : standing("done", "wizard.person.done");
  },
  alignment: ({ sensors, isConnected }) => {
    if (!isConnected) return UNKNOWN;
    const now = sending(sensors);
    if (now.length === 0) return standing("busy", "wizard.alignment.waits");
    const aligned = now.filter((sensor) => sensor.aligned).length;
    if (aligned < now.length) return standing("busy", "wizard.alignment.busy", { aligned, count: now.length });
    if (farApart(now).length > 0) return standing("look", "wizard.alignment.large");
    return standing("done", now.length === 1 ? "wizard.alignment.single" : "wizard.alignment.done");
  },
  arm: ({ confirmedSide, affectedSide }) => {
    if (confirmedSide === null) return standing("open", "wizard.arm.open");
    return confirmedSide === affectedSide
      ? standing("done", `wizard.arm.${affectedSide}`)
      : standing("look", "wizard.arm.wrong");
  },
  limits: ({ areLimitsSigned }) =>
    areLimitsSigned ? standing("done", "wizard.limits.done") : standing("look", "wizard.limits.unsigned"),
  range: ({ isOpen, isRangeTaken }) => {
    if (isRangeTaken) return standing("done", "wizard.range.done");
    return standing("open", isOpen ? "wizard.range.open" : "wizard.later");
  },
  ready: ({ isOpen, mayStart }) => {
    if (!isOpen) return standing("open", "wizard.later");
    return mayStart ? standing("done", "wizard.ready.done") : standing("busy", "wizard.ready.busy");
  },
};

function standing(mark: Mark, words: Key, values: Standing["values"] = {}): Standing {
  return { mark, words, values };
}

/** What still keeps the session from being opened, and the step where it is put right. */
export function missing(facts: Facts): { step: Step; words: Key }[] {
  const found: { step: Step; words: Key }[] = [];
  if (standingOf("person", facts).words === "wizard.person.several") {
    found.push({ step: "person", words: "wizard.missing.person" });
  }
  if (facts.confirmedSide === null) found.push({ step: "arm", words: "prepare.side.missing" });
  else if (facts.confirmedSide !== facts.affectedSide) found.push({ step: "arm", words: "prepare.side.wrong" });
  if (!facts.areLimitsSigned) found.push({ step: "limits", words: "prepare.limits.missing" });
  return found;
}
