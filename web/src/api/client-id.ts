// Which page this is, for the service: whoever opens a session is in charge from that page and from no other.

/** WebSocket code of a stream that ended because the same page was opened once more (a duplicated tab). */
export const OPENED_ELSEWHERE = 4409;
const BYTES = 16;

/** Kept for as long as the tab lives, so that a page that is loaded again is still itself. */
export function clientId(): string {
  return sessionStorage.getItem(keyOf(location.pathname)) ?? renewClientId();
}

/** Becomes another page; it is then in charge of nothing. */
export function renewClientId(): string {
  // not crypto.randomUUID: over plain HTTP in a clinic's network browsers do not offer it
  const bytes = crypto.getRandomValues(new Uint8Array(BYTES));
  const id = [...bytes].map((byte) => byte.toString(16).padStart(2, "0")).join("");
  sessionStorage.setItem(keyOf(location.pathname), id);
  return id;
}

/** A window opened from the dashboard inherits its storage: the patient's screen needs a key of its own. */
export function keyOf(path: string): string {
  return `mirrorlimb.client.${path.endsWith("/play.html") ? "patient" : "dashboard"}`;
}
