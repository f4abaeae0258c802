// The wishes a therapist has of the arm; each button keeps its place. Reset and Start are two acts: none does both.
import type { Action } from "../../api/types";
import { t } from "../../strings";
import { StopButton } from "../stop/button";
import { isPossible, mayWish } from "./actions";
import type { Charge } from "./charge";
import { type Feed, useFromFeed } from "./feed";
import type { Wishes } from "./wishes";

const ACTIONS = ["reset", "start", "hold", "resume"] as const;

interface Props {
  feed: Feed;
  charge: Charge;
  wishes: Wishes;
}

export function Controls({ feed, charge, wishes }: Props) {
  const possible = useFromFeed(feed, 15, possibleOf).split(" ");
  const isStopped = useFromFeed(feed, 10, (now) => now.link === "open" && now.newest?.tick.state === "stopped");
  return (
    <div class="controls">
      {ACTIONS.map((action) => (
        <button
          key={action}
          type="button"
          class={action === "start" || action === "resume" ? "go" : ""}
          disabled={!possible.includes(action) || !mayWish(action, charge)}
          aria-busy={wishes.pending === action}
          title={t(`control.${action}.means`)}
          onClick={() => wishes.wish(action)}
          data-testid={action}
        >
          {t(`control.${action}`)}
          {wishes.pending === action && <span class="key-hint">…</span>}
        </button>
      ))}
      <StopButton {...wishes.stop} isStopped={isStopped} />
    </div>
  );
}

function possibleOf(feed: Feed): string {
  const tick = feed.link === "open" ? (feed.newest?.tick ?? null) : null;
  return ACTIONS.filter((action: Action) => isPossible(action, tick)).join(" ");
}
