// Whether a broken stream means a broken connection, or that nobody is logged in on this screen.
import type { Link } from "../api/live";
import type { Access } from "./screen";

/** What the page should say for a link: asks the service, since a socket refused for want of a log-in says no reason. */
export async function accessOf(link: Link): Promise<Access> {
  if (link !== "lost") return link;
  try {
    const answer = await fetch("/api/me", { headers: { accept: "application/json" } });
    return answer.status === 401 ? "locked" : "lost";
  } catch {
    return "lost";
  }
}
