// Once the session is open: state, wishes and who is in charge, as on the live page; Stop is always there.
import type { Session } from "../../api/types";
import { Authority } from "../live/authority";
import { Controls } from "../live/controls";
import type { Feed } from "../live/feed";
import { StateBanner } from "../live/state-banner";
import { useCharge } from "../live/use-charge";
import { useWishes } from "../live/wishes";
import { ProblemBox } from "../problem";
import { useStopKey } from "../stop/key";

export function OpenHead({ session, feed, account }: { session: Session; feed: Feed; account: string }) {
  const charge = useCharge(feed, account);
  const wishes = useWishes(session.id);
  useStopKey(wishes.stop.press);
  return (
    <>
      <StateBanner feed={feed}>
        <Controls feed={feed} charge={charge} wishes={wishes} />
        <Authority feed={feed} charge={charge} session={session.id} account={account} />
      </StateBanner>
      <ProblemBox problem={wishes.problem} onClose={wishes.forget} />
    </>
  );
}
