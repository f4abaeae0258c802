// What this page remembers of the session that it showed, for the leave-taking when it is closed, half-way or not.
import type { LiveMessage } from "../api/types";

export interface Visit {
  readonly session: number;
  readonly points: number;
  /** When the leave-taking ends, by this screen's clock; null while the session lasts. */
  readonly until_s: number | null;
}

/** So long the patient is told what was won; then the screen is the next one's. */
export const LEAVE_S = 120;

/** The visit after a message that came at `now_s`; null while nothing has been played. */
export function visitAfter(visit: Visit | null, { session, game }: LiveMessage, now_s: number): Visit | null {
  if (session && game) return { session: session.id, points: game.total_score, until_s: null };
  if (session) return visit?.session === session.id ? visit : null;
  if (!visit) return null;
  const until_s = visit.until_s ?? now_s + LEAVE_S;
  return now_s > until_s ? null : { ...visit, until_s };
}
