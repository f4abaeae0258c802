// What may be wished in which state, by whom.
import type { Action, LiveTick } from "../../api/types";
import type { Charge } from "./charge";

/** Those that need a person in charge; everybody may hold and stop. */
const IN_CHARGE: readonly Action[] = ["start", "resume", "reset"];

/** Whether somebody may wish it; what is really allowed the service decides, this spares a useless press. */
export function mayWish(action: Action, charge: Charge): boolean {
  return charge === "mine" || !IN_CHARGE.includes(action);
}

/** Whether it would do anything in the arm's present state. */
export function isPossible(action: Action, tick: LiveTick | null): boolean {
  return action === "stop" || (tick !== null && fits(action, tick));
}

function fits(action: Action, { state, may_enable }: LiveTick): boolean {
  switch (state) {
    case "ready":
      return action === "start" && may_enable;
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
