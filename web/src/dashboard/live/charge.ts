// Who is in charge of the open session: one page of one account.
import type { Authority, LiveMessage } from "../../api/types";

/** `gone`: somebody was in charge, and their page is not there any more. */
export type Charge = "mine" | "other" | "gone";

/** This page, as the service knows it. */
export interface Me {
  account: string;
  client: string;
}

export function authorityOf(message: LiveMessage | null): Authority | null {
  return message?.session?.authority ?? null;
}

export function chargeOf(authority: Authority | null, me: Me): Charge {
  if (authority === null) return "gone";
  if (authority.client === me.client && authority.account === me.account) return "mine";
  return authority.connected ? "other" : "gone";
}
