// Play, pause, speed, and the time line of a replay.
import type { Timeline } from "../../api/types";
import { t } from "../../strings";
import { duration } from "../format";
import { TimeLine } from "./line";
import { type Player, usePosition } from "./player";
import { eventsOf, type Heard, LEAD_S, type LineEvent, neighbour } from "./position";

const SPEEDS = [0.25, 0.5, 1, 2, 4];
const END_S = 0.05;

interface Props {
  heard: Heard;
  timeline: Timeline | null;
  onDrive: Player["drive"];
}

export function ReplayControls({ heard, timeline, onDrive }: Props) {
  const t_s = usePosition(heard);
  const { duration_s } = heard.replay;
  const events = timeline ? eventsOf(timeline) : [];
  const isOver = t_s >= duration_s - END_S;
  const plays = heard.replay.playing && !isOver;
  const goTo = (event: LineEvent) => onDrive({ t_s: Math.max(0, event.t_s - LEAD_S) });
  return (
    <section class="card replay-controls" aria-label={t("replay.controls")}>
      <div class="row">
        <button
          type="button"
          class="primary replay-play"
          onClick={() => onDrive(plays ? { playing: false } : { playing: true, ...(isOver && { t_s: 0 }) })}
          data-testid="replay-play"
          data-playing={plays}
        >
          <span aria-hidden="true">{plays ? "❚❚" : "▶"}</span> {t(plays ? "replay.pause" : "replay.play")}
        </button>
        <Jump
          name={t("replay.before")}
          sign="⇤"
          event={neighbour(events, t_s, -1)}
          onGo={goTo}
          testId="replay-before"
        />
        <Jump name={t("replay.after")} sign="⇥" event={neighbour(events, t_s, 1)} onGo={goTo} testId="replay-after" />
        <Speed speed={heard.replay.speed} onChoose={(speed) => onDrive({ speed })} />
        <output class="replay-position" data-testid="replay-position" data-seconds={t_s.toFixed(1)}>
          {t("replay.position.of", { at: duration(t_s), all: duration(duration_s) })}
        </output>
      </div>
      <input
        type="range"
        class="replay-scrub"
        min={0}
        max={duration_s}
        step={0.1}
        value={t_s}
        aria-label={t("replay.position")}
        aria-valuetext={t("replay.position.of", { at: duration(t_s), all: duration(duration_s) })}
        onInput={(event) => onDrive({ t_s: Number(event.currentTarget.value) })}
        data-testid="replay-scrub"
      />
      {timeline && <TimeLine timeline={timeline} t_s={t_s} />}
      <EventButtons events={events} onGo={goTo} />
    </section>
  );
}

interface JumpProps {
  name: string;
  sign: string;
  event: LineEvent | null;
  onGo: (event: LineEvent) => void;
  testId: string;
}

function Jump({ name, sign, event, onGo, testId }: JumpProps) {
  return (
    <button type="button" disabled={!event} onClick={() => event && onGo(event)} data-testid={testId}>
      <span aria-hidden="true">{sign}</span> {name}
    </button>
  );
}

function Speed({ speed, onChoose }: { speed: number; onChoose: (speed: number) => void }) {
  return (
    <label class="replay-speed">
      {t("replay.speed")}
      <select
        value={String(speed)}
        onChange={(event) => onChoose(Number(event.currentTarget.value))}
        data-testid="replay-speed"
      >
        {SPEEDS.map((one) => (
          <option key={one} value={String(one)}>
            {t("replay.speed.times", { speed: one })}
          </option>
        ))}
      </select>
    </label>
  );
}

/** Every event as a button: what the time line marks, for those who read it or use the keyboard. */
function EventButtons({ events, onGo }: { events: readonly LineEvent[]; onGo: (event: LineEvent) => void }) {
  if (events.length === 0) return <p class="soft small">{t("replay.events.none")}</p>;
  return (
    <details>
      <summary>
        {t("replay.events")} ({events.length})
      </summary>
      <ul class="replay-events">
        {events.map((event) => (
          <li key={`${event.kind}${event.t_s}`}>
            <button type="button" onClick={() => onGo(event)} data-testid="replay-event" data-kind={event.kind}>
              {duration(event.t_s)} · {t(`replay.mark.${event.kind}`)}
            </button>
          </li>
        ))}
      </ul>
    </details>
  );
}
