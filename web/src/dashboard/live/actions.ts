// What may be wished in which state, and sending it; stop is always allowed and sent more than once if it must be.
import { control, Problem } from "../../api/client";
import type { Action, LiveTick } from "../../api/types";

/** Whether a button does anything now. What is really allowed the station decides; this spares a useless press. */
export function isPossible(action: Action, tick: LiveTick | null): boolean {
  if (action === "stop") return true;
  switch (tick?.state) {
    case "ready":
      return action === "start" && tick.may_enable;
    case "engaged":
      return action === "hold";
    case "hold":
      return action === "resume";
    case "fault":
    case "stopped":
      return action === "reset";
    default:
      return false;
  }
}

const STOP_ATTEMPTS = 4;
const BETWEEN_ATTEMPTS_MS = 150;

/** Sends a wish; a stop that got no answer is sent again at once. */
export async function send(session: number, action: Action): Promise<void> {
  const attempts = action === "stop" ? STOP_ATTEMPTS : 1;
  for (let attempt = 1; ; attempt += 1) {
    try {
      await control(session, action);
      return;
    } catch (error) {
      const answered = error instanceof Problem && error.status !== 0;
      if (answered || attempt >= attempts) throw error;
      await new Promise((resolve) => setTimeout(resolve, BETWEEN_ATTEMPTS_MS));
    }
  }
}

/** Space and Escape stop the arm, wherever the focus is, except while somebody is writing. */
export function isStopKey(event: KeyboardEvent): boolean {
  if (event.key === "Escape") return true;
  return event.key === " " && !isWriting(event.target);
}

function isWriting(target: EventTarget | null): boolean {
  const tag = (target as HTMLElement | null)?.tagName;
  return tag === "INPUT" || tag === "TEXTAREA" || tag === "SELECT";
}
