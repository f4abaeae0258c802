// Why the arm waits, as far as it helps a patient: the station's own sentences are technical and English.
import type { LiveTick } from "../api/types";
import type { Key } from "../strings";
import type { Face } from "./screen";

/** What the station's sentence is about; the first that fits. */
const ABOUT: readonly [RegExp, Key][] = [
  [/pressed hold/i, "play.reason.person"],
  [/pressed pain|it hurts/i, "play.reason.pain"],
  [/resists|moves faster than allowed/i, "play.reason.resisted"],
  [/took over/i, "play.reason.taken"],
  [/in charge|service is silent/i, "play.reason.alone"],
  [/too far from/i, "play.reason.apart"],
  [/no sensor sees|not seen well|too uncertain/i, "play.reason.unseen"],
];

/** A sentence for the patient, or null where the face says all that they need to know. */
export function reasonFor(face: Face, tick: Pick<LiveTick, "reason" | "blockers" | "sensors"> | undefined): Key | null {
  if (!tick || (face !== "paused" && face !== "eased" && face !== "ready")) return null;
  if (face === "ready" && tick.sensors.length === 0) return "play.reason.sensors";
  const words = face === "ready" ? tick.blockers.join(" ") : tick.reason;
  return ABOUT.find(([pattern]) => pattern.test(words))?.[1] ?? null;
}
