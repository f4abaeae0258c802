// What pages share of state: the language, the address, what has been asked of the service.
import { useCallback, useEffect, useState } from "preact/hooks";
import { NOT_LOGGED_IN, Problem } from "../api/client";
import { onLanguage } from "../strings";
import { type Route, routeOf } from "./route";

/** Draws the caller again whenever the language changes. */
export function useLanguage(): void {
  const [, redraw] = useState(0);
  useEffect(() => onLanguage(() => redraw((count) => count + 1)), []);
}

export function useRoute(): Route {
  const [route, setRoute] = useState(() => routeOf(location.hash));
  useEffect(() => {
    const follow = () => setRoute(routeOf(location.hash));
    window.addEventListener("hashchange", follow);
    return () => window.removeEventListener("hashchange", follow);
  }, []);
  return route;
}

/** Fired on the window when it should be asked again who is logged in: perhaps nobody is any more. */
export const ASK_WHO = "mirrorlimb:ask-who";

export interface Asked<T> {
  value: T | null;
  /** True once there has been an answer, which may itself be null. */
  answered: boolean;
  problem: Problem | null;
  again: () => void;
}

/** Asks once, and again when `subject` changes or `again` is called. */
export function useAsked<T>(ask: () => Promise<T>, subject: unknown): Asked<T> {
  const [value, setValue] = useState<T | null>(null);
  const [problem, setProblem] = useState<Problem | null>(null);
  const [answered, setAnswered] = useState(false);
  const [round, setRound] = useState(0);
  // `subject` and `round` say when to ask again; `ask` itself is a new function at every drawing.
  useEffect(() => {
    let wanted = true;
    ask()
      .then((answer) => {
        if (!wanted) return;
        setValue(() => answer);
        setAnswered(true);
        setProblem(null);
      })
      .catch((error: unknown) => wanted && setProblem(problemOf(error)));
    return () => {
      wanted = false;
    };
  }, [subject, round]);
  return { value, answered, problem, again: useCallback(() => setRound((count) => count + 1), []) };
}

export interface Doing {
  busy: boolean;
  problem: Problem | null;
  /** Runs `act`, one at a time, and keeps what went wrong. */
  run: (act: () => Promise<void>) => void;
  forget: () => void;
}

/** Something a person has the page do: a form sent, a button pressed. */
export function useDoing(): Doing {
  const [busy, setBusy] = useState(false);
  const [problem, setProblem] = useState<Problem | null>(null);
  const run = (act: () => Promise<void>) => {
    setBusy(true);
    setProblem(null);
    act()
      .catch((error: unknown) => setProblem(problemOf(error)))
      .finally(() => setBusy(false));
  };
  return { busy, problem, run, forget: () => setProblem(null) };
}

/** What went wrong, as something a person can read; anything else is a mistake of ours and is thrown on. */
export function problemOf(error: unknown): Problem {
  if (!(error instanceof Problem)) throw error;
  if (error.status === NOT_LOGGED_IN) window.dispatchEvent(new Event(ASK_WHO));
  return error;
}
