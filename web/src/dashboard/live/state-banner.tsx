// The arm's state, large: sign, word, why, and what to do next.
import type { DriveState, LiveTick } from "../../api/types";
import { t } from "../../strings";
import { sentence } from "../format";
import { type Feed, useFromFeed } from "./feed";
import { StateSign } from "./state-sign";

export function StateBanner({ feed, children }: { feed: Feed; children: preact.ComponentChildren }) {
  const shown = useFromFeed(feed, 15, faceOf);
  const { state, reason, next } = JSON.parse(shown) as Face;
  return (
    <section class={`state state-${state}`} aria-live="assertive">
      <div class="state-said">
        <StateSign state={state} />
        <div>
          <div class="state-word" data-testid="state" data-state={state}>
            {t(`state.${state}`)}
          </div>
          <div class="state-reason">{[reason, next || t(`state.${state}.next`)].filter(Boolean).join(" ")}</div>
        </div>
      </div>
      {children}
    </section>
  );
}

interface Face {
  state: DriveState | "lost";
  reason: string;
  /** What the service says is missing; "" where the usual next step is meant. */
  next: string;
}

/** The banner as text, so that it is drawn again only when it says something else. */
function faceOf(feed: Feed): string {
  const face: Face =
    feed.link === "open" && feed.newest ? faceOfTick(feed.newest.tick) : { state: "lost", reason: "", next: "" };
  return JSON.stringify(face);
}

function faceOfTick(tick: LiveTick): Face {
  const waiting = (tick.state === "ready" || tick.state === "off") && !tick.may_enable;
  const next = waiting ? tick.blockers.map(asSentence).join(" ") : "";
  const reason = waiting && tick.blockers.includes(tick.reason) ? "" : tick.reason;
  return { state: tick.state, reason: asSentence(reason), next };
}

function asSentence(phrase: string): string {
  if (!phrase) return "";
  return /[.!?。！？]$/.test(phrase) ? sentence(phrase) : `${sentence(phrase)}.`;
}
