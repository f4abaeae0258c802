// What the therapist has wished of the arm, what is not answered yet, and what was refused.
import { useState } from "preact/hooks";
import { control, type Problem } from "../../api/client";
import type { Action } from "../../api/types";
import { useDoing } from "../hooks";
import { type StopPress, useStopPress } from "../stop/press";

export interface Wishes {
  /** What has been pressed and is not answered yet. */
  pending: Action | null;
  problem: Problem | null;
  forget: () => void;
  wish: (action: Action) => void;
  stop: StopPress;
}

export function useWishes(session: number): Wishes {
  const doing = useDoing();
  const stop = useStopPress(session);
  const [pressed, setPressed] = useState<Action | null>(null);
  const wish = (action: Action) => {
    setPressed(action);
    doing.run(async () => {
      await control(session, action);
    });
  };
  const forget = () => {
    doing.forget();
    stop.forget();
  };
  return { pending: doing.busy ? pressed : null, problem: stop.problem ?? doing.problem, forget, wish, stop };
}
