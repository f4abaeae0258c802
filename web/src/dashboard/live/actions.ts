// What may be wished in which state, by whom.
import type { Action, LiveTick } from "../../api/types";
import type { Charge } from "./charge";

/** Those that need a person in charge; everybody may hold and stop. */
const IN_CHARGE: readonly Action[] = ["start", "resume", "reset"];

/** Whether a button does anything now. What is really allowed the station decides; this spares a useless press. */
export function isPossible(action: Action, tick: LiveTick | null, charge: Charge): boolean {
  if (action === "stop") return true;
  if (IN_CHARGE.includes(action) && charge !== "mine") return false;
  return tick !== null && fits(action, tick);
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
