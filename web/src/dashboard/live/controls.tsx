// The five wishes a therapist has of the arm; each button keeps its place.
import type { Action } from "../../api/types";
import { t } from "../../strings";
import { isPossible } from "./actions";
import { type Feed, useFromFeed } from "./feed";

const ACTIONS: readonly Action[] = ["start", "hold", "resume", "reset", "stop"];

interface Props {
  feed: Feed;
  /** What has been pressed and is not answered yet. */
  pending: Action | null;
  onWish: (action: Action) => void;
}

export function Controls({ feed, pending, onWish }: Props) {
  const possible = useFromFeed(feed, 15, possibleOf).split(" ");
  return (
    <div class="controls">
      {ACTIONS.map((action) => (
        <button
          key={action}
          type="button"
          class={classOf(action)}
          disabled={!possible.includes(action)}
          aria-busy={pending === action}
          onClick={() => onWish(action)}
          data-testid={action}
        >
          {t(`control.${action}`)}
          {pending === action && action !== "stop" && <span class="key-hint">…</span>}
          {action === "stop" && <span class="key-hint">{t("control.stop.keys")}</span>}
        </button>
      ))}
    </div>
  );
}

function possibleOf(feed: Feed): string {
  const tick = feed.link === "open" ? (feed.newest?.tick ?? null) : null;
  return ACTIONS.filter((action) => isPossible(action, tick)).join(" ");
}

function classOf(action: Action): string {
  if (action === "stop") return "stop";
  return action === "start" || action === "resume" ? "go" : "";
}
