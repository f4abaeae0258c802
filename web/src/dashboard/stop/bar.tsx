// The stop on pages other than the live one, for as long as a session is open.
import type { DriveState } from "../../api/types";
import { t } from "../../strings";
import { type Feed, useFromFeed } from "../live/feed";
import { StateSign } from "../live/state-sign";
import { ProblemBox } from "../problem";
import { hrefOf } from "../route";
import { StopButton } from "./button";
import { useStopKey } from "./key";
import { useStopPress } from "./press";

export function StopBar({ feed }: { feed: Feed }) {
  const session = useFromFeed(feed, 4, ({ newest }) => newest?.session?.id ?? null);
  return session === null ? null : <Bar feed={feed} session={session} />;
}

function Bar({ feed, session }: { feed: Feed; session: number }) {
  const state = useFromFeed(feed, 10, stateOf);
  const patient = useFromFeed(feed, 1, ({ newest }) => newest?.session?.patient ?? "");
  const stop = useStopPress(session);
  useStopKey(stop.press);
  return (
    <aside class={`stop-bar state-${state}`} aria-label={t("stop.bar")} data-testid="stop-bar">
      <StateSign state={state} />
      <div class="stop-bar-said">
        <strong data-testid="bar-state" data-state={state}>
          {t(`state.${state}`)}
        </strong>
        <span class="small">{patient}</span>
      </div>
      <a class="button" href={hrefOf({ page: "live" })}>
        {t("nav.live")}
      </a>
      <StopButton {...stop} isStopped={state === "stopped"} />
      <ProblemBox problem={stop.problem} onClose={stop.forget} />
    </aside>
  );
}

function stateOf(feed: Feed): DriveState | "lost" {
  return feed.link === "open" && feed.newest ? feed.newest.tick.state : "lost";
}
