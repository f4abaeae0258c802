// The tests whose scores are entered: how far each scale goes, and what change on it is known to be more than chance.
import type { Score } from "../../api/types";

export type Kind = Score["kind"];

/** In the order in which a form offers them. */
export const KINDS: readonly Kind[] = ["fugl-meyer-ue", "arat", "box-and-block"];

/** The service refuses more. */
export const GREATEST: Record<Kind, number> = { "fugl-meyer-ue": 66, arat: 57, "box-and-block": 150 };
