// Which of its few faces the patient's screen shows: playing, or one plain sentence about what is going on.
import { type Link, STALE_S } from "../api/live";
import type { LiveMessage } from "../api/types";
import type { Visit } from "./visit";

export type Face =
  | "connecting"
  | "lost"
  | "locked"
  | "welcome"
  | "ready"
  | "paused"
  | "eased"
  | "stopped"
  | "fault"
  | "waiting"
  | "break"
  | "rest"
  | "between"
  | "over"
  | "ended"
  | "noscene"
  | "playing";

type GamePhase = NonNullable<LiveMessage["game"]>["phase"];

/** The connection as this page knows it: `locked` when the service answers but nobody has logged in here. */
export type Access = Link | "locked";

/** The face for this connection and the newest message, which came `age_s` ago; `visit` is what was played before. */
export function faceFor(link: Access, message: LiveMessage | null, age_s: number, visit: Visit | null): Face {
  if (link === "lost" || link === "locked") return link;
  if (!message) return link === "open" ? "welcome" : "connecting";
  if (age_s > STALE_S) return "lost";
  if (message.game?.phase === "over") return "over";
  const { tick } = message;
  if (!message.session || !tick?.session) return visit ? "ended" : "welcome";
  return tick.state === "engaged" ? faceOfGame(message.game?.phase) : faceOfState(tick);
}

/** A hold that gives way (pain, resistance) is another one than a pause. */
function faceOfState({ state, exo }: LiveMessage["tick"]): Face {
  if (state === "hold") return exo.compliant ? "eased" : "paused";
  if (state === "stopped" || state === "fault") return state;
  return "ready";
}

const OF_PHASE: Readonly<Record<GamePhase, Face>> = {
  waiting: "waiting",
  playing: "playing",
  rest: "rest",
  paused: "break",
  between: "between",
  over: "over",
};

function faceOfGame(phase: GamePhase | undefined): Face {
  return phase ? OF_PHASE[phase] : "waiting";
}

/** The side whose arm is shown. */
export function affectedSide(healthySide: string): "left" | "right" {
  return healthySide === "left" ? "right" : "left";
}

/** Seconds as a person reads them: 65 → "1:05". Rounded up, so that "0:00" means over. */
export function clockText(seconds: number): string {
  const whole = Math.max(0, Math.ceil(seconds));
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
}
