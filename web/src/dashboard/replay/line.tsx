// The time line as a picture: the arm's states as a band, events as signs of their own shape.
import type { Timeline } from "../../api/types";
import { t } from "../../strings";
import { translatedOr } from "../session/metrics";
import { type EventKind, eventsOf } from "./position";

const WIDTH = 1000;
const BAND_Y = 4;
const BAND_HEIGHT = 18;
const SIGN_Y = 40;
const HEIGHT = 54;

/** Shapes, so that colour is not needed: up = hit, ring = missed, cross = pain. */
const SIGNS: Partial<Record<EventKind, string>> = {
  hit: "M0 -9 L8 6 L-8 6 Z",
  missed: "M-6 0 a6 6 0 1 0 12 0 a6 6 0 1 0 -12 0",
  pain: "M-7 -7 L7 7 M7 -7 L-7 7",
};

export function TimeLine({ timeline, t_s }: { timeline: Timeline; t_s: number }) {
  const x = (at_s: number) => (WIDTH * at_s) / Math.max(timeline.duration_s, 1e-9);
  const events = eventsOf(timeline).filter(({ kind }) => SIGNS[kind]);
  return (
    <div class="replay-line">
      <svg
        viewBox={`-10 0 ${WIDTH + 20} ${HEIGHT}`}
        preserveAspectRatio="none"
        role="img"
        aria-label={t("replay.line")}
      >
        <defs>
          <pattern id="halted" width="8" height="8" patternTransform="rotate(45)" patternUnits="userSpaceOnUse">
            <rect width="8" height="8" fill="#fff0d9" />
            <rect width="4" height="8" fill="#8a4b00" />
          </pattern>
        </defs>
        {timeline.spans.map(({ state, from_s, to_s }) => (
          <rect
            key={from_s}
            class={`replay-span replay-${state}`}
            x={x(from_s)}
            y={BAND_Y}
            width={Math.max(x(to_s) - x(from_s), 1)}
            height={BAND_HEIGHT}
          />
        ))}
        {events.map(({ kind, t_s: at_s }) => (
          <path
            key={`${kind}${at_s}`}
            class={`replay-${kind}`}
            d={SIGNS[kind]}
            transform={`translate(${x(at_s)} ${SIGN_Y})`}
          />
        ))}
        <line class="replay-now" x1={x(t_s)} x2={x(t_s)} y1="0" y2={HEIGHT} />
      </svg>
      <LineKey timeline={timeline} />
    </div>
  );
}

/** What the band's patterns and the signs mean; only of what there is. */
function LineKey({ timeline }: { timeline: Timeline }) {
  const states = [...new Set(timeline.spans.map(({ state }) => state))];
  const kinds = [...new Set(eventsOf(timeline).map(({ kind }) => kind))].filter((kind) => SIGNS[kind]);
  return (
    <ul class="replay-key small">
      {states.map((state) => (
        <li key={state}>
          <svg viewBox="0 0 24 14" width="24" height="14" aria-hidden="true">
            <rect class={`replay-span replay-${state}`} width="24" height="14" />
          </svg>
          {translatedOr(`state.${state}`, state)}
        </li>
      ))}
      {kinds.map((kind) => (
        <li key={kind}>
          <svg viewBox="-11 -11 22 22" width="18" height="18" aria-hidden="true">
            <path class={`replay-${kind}`} d={SIGNS[kind]} />
          </svg>
          {t(`replay.mark.${kind}`)}
        </li>
      ))}
    </ul>
  );
}
