// Whether this page is in charge, as the stream says it.
import { clientId } from "../../api/client-id";
import { authorityOf, type Charge, chargeOf } from "./charge";
import { type Feed, useFromFeed } from "./feed";

export function useCharge(feed: Feed, account: string): Charge {
  return useFromFeed(feed, 5, ({ newest }) => chargeOf(authorityOf(newest), { account, client: clientId() }));
}
