// Pressing stop, and what is seen of it: at once that it was sent, after the answer that it was done.
import { useRef, useState } from "preact/hooks";
import { Problem } from "../../api/client";
import { type Progress, sendUrgent } from "../../api/urgent";
import { t } from "../../strings";
import { problemOf } from "../hooks";

/** How long "done" stays; a stop that nobody answered stays until the next press. */
const SHOWN_MS = 5000;

export interface StopPress {
  progress: Progress;
  problem: Problem | null;
  press: () => void;
  forget: () => void;
}

export function useStopPress(session: number): StopPress {
  const [progress, setProgress] = useState<Progress>("idle");
  const [problem, setProblem] = useState<Problem | null>(null);
  const newest = useRef(0);
  const press = () => {
    newest.current += 1;
    const mine = newest.current;
    const show = (next: Progress) => mine === newest.current && setProgress(next);
    show("sent");
    setProblem(null);
    sendUrgent(session, "stop")
      .then(() => {
        show("done");
        setTimeout(() => show("idle"), SHOWN_MS);
      })
      .catch((error: unknown) => {
        show("unanswered");
        setProblem(worded(problemOf(error)));
      });
  };
  return { progress, problem, press, forget: () => setProblem(null) };
}

/** Whoever gets no answer to a stop must not read about networks first. */
function worded(problem: Problem): Problem {
  if (problem.status !== 0) return problem;
  return new Problem(0, { what: t("stop.problem"), expected: "", remedy: t("stop.problem.remedy") });
}
