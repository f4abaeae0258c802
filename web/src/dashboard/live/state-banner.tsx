// The arm's state, large: sign, word, why, and what to do next.
import type { Assistance, LiveMessage, LiveTick } from "../../api/types";
import { t } from "../../strings";
import { sentence } from "../format";
import { type Feed, useFromFeed } from "./feed";
import { type BannerState, StateSign } from "./state-sign";
import "./state.css";

export function StateBanner({ feed, children }: { feed: Feed; children: preact.ComponentChildren }) {
  const shown = useFromFeed(feed, 15, faceOf);
  const { state, reasons, manner } = JSON.parse(shown) as Face;
  const word = isBlocked(state, reasons) ? "waiting" : state;
  return (
    <section class={`state state-${word}`}>
      <div class="state-said" aria-live="assertive">
        <StateSign state={state} />
        <div>
          <div class="state-word" data-testid="state" data-state={state}>
            {t(manner === "soft" && word === "hold" ? "state.soft" : `state.${word}`)}
          </div>
          <div class="state-reason" data-testid="state-reason">
            {[...reasons.map(asSentence), ...nextOf(state, reasons, manner)].join("")}
          </div>
        </div>
      </div>
      {children}
    </section>
  );
}

interface Face {
  state: BannerState;
  /** Why it is so, or what is still missing, in the service's words. */
  reasons: readonly string[];
  /** How the arm is helped while it moves; `soft` where a hold gives way. */
  manner: Assistance | "soft";
}

/** What to do next; where something is missing, its own words have said that already. */
function nextOf(state: Face["state"], reasons: readonly string[], manner: Face["manner"]): string[] {
  const isSaid = isBlocked(state, reasons) || (state === "off" && reasons.length > 0);
  if (isSaid) return [];
  if (state === "hold" && manner === "soft") return [t("state.soft.next")];
  return [state === "engaged" && manner !== "soft" ? t(`state.engaged.${manner}`) : t(`state.${state}.next`)];
}

/** Ready says the station of itself also while it would refuse Start. */
function isBlocked(state: Face["state"], reasons: readonly string[]): boolean {
  return state === "ready" && reasons.length > 0;
}

/** The banner as text, so that it is drawn again only when it says something else. */
function faceOf(feed: Feed): string {
  return JSON.stringify(feed.link === "open" && feed.newest ? faceOfMessage(feed.newest) : faceWithout(feed));
}

function faceWithout(feed: Feed): Face {
  return { state: feed.link === "lost" ? "lost" : "connecting", reasons: [], manner: "passive" };
}

/** Once the station has died, a session can only be ended, whatever the arm's state. */
function faceOfMessage({ tick, session }: LiveMessage): Face {
  const isCut = session?.phase === "interrupted";
  return isCut ? { state: "interrupted", reasons: [], manner: "passive" } : faceOfTick(tick);
}

/** Ready and moving explain themselves; what still blocks the way says more than the state's own reason. */
function faceOfTick({ state, reason, may_enable, blockers, exo }: LiveTick): Face {
  const waits = (state === "ready" || state === "off") && !may_enable;
  const tellsWhy = state === "hold" || state === "fault" || state === "stopped";
  const reasons = waits ? blockers : tellsWhy && reason ? [reason] : [];
  return { state, reasons, manner: exo.compliant ? "soft" : exo.assistance };
}

function asSentence(phrase: string): string {
  return t("state.sentence", { words: sentence(phrase) });
}
