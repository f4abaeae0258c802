// The live stream as the page uses it: a plain object that always holds the newest message.
import { useEffect, useRef, useState } from "preact/hooks";
import { connectLive, type Link, STALE_S } from "../../api/live";
import type { LiveMessage } from "../../api/types";
import { ASK_WHO } from "../hooks";
import { Lately } from "./lately";
import { Traces } from "./traces";

export class Feed {
  newest: LiveMessage | null = null;
  /** What the connection says of itself. */
  connection: Link = "connecting";
  private arrived_s = 0;
  readonly traces = new Traces();
  private readonly clamps = new Lately();

  /** How things stand; a service that hangs breaks no connection, yet what it said last is no longer true. */
  get link(): Link {
    const isStale = this.newest !== null && seconds() - this.arrived_s > STALE_S;
    return this.connection === "open" && isStale ? "lost" : this.connection;
  }

  take(message: LiveMessage): void {
    this.newest = message;
    this.arrived_s = seconds();
    this.traces.take(message.tick);
    this.clamps.take(message.tick.exo.clamped, this.arrived_s);
  }

  /** What the limits have changed within the last seconds, and why. */
  clampedLately(): string[] {
    return this.clamps.at(seconds());
  }
}

function seconds(): number {
  return performance.now() / 1000;
}

/**
 * A feed that follows the stream for as long as somebody is logged in. It is kept from page to page: to be in charge
 * means to be connected, and to stop on any page one has to know that a session is open.
 */
export function useFeed(account: string | null): Feed {
  const [feed] = useState(() => new Feed());
  useEffect(() => (account === null ? undefined : follow(feed)), [feed, account]);
  return feed;
}

function follow(feed: Feed): () => void {
  const connection = connectLive(
    "dashboard",
    (message) => feed.take(message),
    (link) => {
      feed.connection = link;
      // The stream also breaks when the log-in has run out, and a browser is not told why it was refused.
      if (link === "lost") window.dispatchEvent(new Event(ASK_WHO));
    },
  );
  return () => {
    connection.close();
    feed.newest = null;
  };
}

/**
 * What `read` finds in the feed, looked at `timesPerS` times a second. The caller is drawn again only when `read` finds
 * another value than before, so whoever reads a word is drawn only when the word changes.
 */
export function useFromFeed<T>(feed: Feed, timesPerS: number, read: (feed: Feed) => T): T {
  const [value, setValue] = useState(() => read(feed));
  // `read` is a function written anew at every drawing: the newest is asked, since it may know more than the first.
  const asked = useRef(read);
  asked.current = read;
  useEffect(() => {
    const timer = setInterval(() => setValue(() => asked.current(feed)), 1000 / timesPerS);
    return () => clearInterval(timer);
  }, [feed, timesPerS]);
  return value;
}
