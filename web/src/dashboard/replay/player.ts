// The replay at the service, as this page drives it.
import { useEffect, useRef, useState } from "preact/hooks";
import { playAgain, readReplay, readTimeline } from "../../api/client";
import type { ReplayForm, Timeline } from "../../api/types";
import { type Doing, useDoing } from "../hooks";
import { type Heard, positionAt } from "./position";

/** Somebody else may drive it too, a session may be opened, the service may put it away. */
const ASKED_EVERY_MS = 2000;
const DRAWN_EVERY_MS = 100;

type Wish = Partial<Omit<ReplayForm, "session_id">>;

/** A slider is dragged faster than a service answers: one wish is on its way, the newest waits. */
interface Queue {
  busy: boolean;
  next: Wish | null;
}

export interface Player {
  heard: Heard | null;
  timeline: Timeline | null;
  /** It was shown, and is no longer. */
  isGone: boolean;
  doing: Doing;
  /** Changes how it runs; what is left out stays. */
  drive: (wish: Wish) => void;
}

export function usePlayer(session: number): Player {
  const [heard, setHeard] = useState<Heard | null>(null);
  const [timeline, setTimeline] = useState<Timeline | null>(null);
  const [isGone, setGone] = useState(false);
  const doing = useDoing();

  const queue = useRef<Queue>({ busy: false, next: null });
  const send = async (wish: Wish): Promise<void> => {
    const { playing, speed } = heard?.replay ?? { playing: true, speed: 1 };
    const replay = await playAgain({ session_id: session, playing, speed, ...wish });
    const { next } = queue.current;
    queue.current.next = null;
    if (next) return send({ ...wish, t_s: null, ...next });
    setHeard({ replay, at_ms: performance.now() });
    if (timeline === null || isGone) setTimeline(await readTimeline());
    setGone(false);
  };
  const drive: Player["drive"] = (wish) => {
    if (heard) setHeard(wished(heard, wish));
    if (queue.current.busy) {
      queue.current.next = { ...queue.current.next, ...wish };
      return;
    }
    queue.current.busy = true;
    doing.run(() => send(wish).finally(() => (queue.current = { busy: false, next: null })));
  };

  useEffect(() => drive({ t_s: 0 }), [session]);
  useEffect(() => {
    if (!heard || isGone) return;
    const look = async () => {
      const replay = await readReplay().catch(() => undefined);
      if (replay === undefined) return; // no answer: the next look may have one
      if (replay?.session_id === session) setHeard({ replay, at_ms: performance.now() });
      else setGone(true);
    };
    const timer = setInterval(look, ASKED_EVERY_MS);
    return () => clearInterval(timer);
  }, [heard === null, isGone, session]);
  return { heard, timeline, isGone, doing, drive };
}

/** How it will stand, shown before the service has answered. */
function wished(heard: Heard, wish: Wish): Heard {
  const now_ms = performance.now();
  const { playing = heard.replay.playing, speed = heard.replay.speed } = wish;
  return { replay: { ...heard.replay, playing, speed, t_s: wish.t_s ?? positionAt(heard, now_ms) }, at_ms: now_ms };
}

/** The position, drawn anew ten times a second while it moves. */
export function usePosition(heard: Heard): number {
  const [, redraw] = useState(0);
  const { playing } = heard.replay;
  useEffect(() => {
    if (!playing) return;
    const timer = setInterval(() => redraw((count) => count + 1), DRAWN_EVERY_MS);
    return () => clearInterval(timer);
  }, [playing]);
  return positionAt(heard, performance.now());
}
