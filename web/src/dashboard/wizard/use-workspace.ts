// How far the healthy arm has shown that it goes, asked of the service while the session is prepared.
import { useEffect } from "preact/hooks";
import { readWorkspace } from "../../api/client";
import type { Session, SessionWorkspace } from "../../api/types";
import { type Asked, useAsked } from "../hooks";

const EVERY_MS = 700;

/** Asked again and again while `isWatched`; null while no session is open. */
export function useWorkspace(session: Session | null, isWatched: boolean): Asked<SessionWorkspace | null> {
  const id = session?.id ?? null;
  const asked = useAsked(async () => (id === null ? null : readWorkspace(id)), id);
  const { again } = asked;
  useEffect(() => {
    if (id === null || !isWatched) return undefined;
    const timer = setInterval(again, EVERY_MS);
    return () => clearInterval(timer);
  }, [id, isWatched, again]);
  return asked;
}
