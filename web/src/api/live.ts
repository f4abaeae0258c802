// The live stream: one message at a time from the service, acknowledged once it can have been drawn.
import { clientId, OPENED_ELSEWHERE, renewClientId } from "./client-id";
import type { LiveMessage, Screen } from "./types";

/** Without news for this long what is shown is no longer true, whatever the connection says of itself. */
export const STALE_S = 1;

/** How the connection stands; `lost` means that it is being tried again. */
export type Link = "connecting" | "open" | "lost";

export interface LiveConnection {
  /** Ends the stream for good. */
  close(): void;
}

const FIRST_RETRY_MS = 250;
const LONGEST_RETRY_MS = 3000;
/** A window that is about to be hidden may never get its animation frame; it still has to answer. */
const LATEST_ACK_MS = 400;

/** Where the stream of the page `client` is, seen from a page at `page`. */
export function streamAddress(page: URL, client: string): string {
  return `${page.protocol === "https:" ? "wss:" : "ws:"}//${page.host}/api/stream?client=${client}`;
}

/** How long to wait before attempt number `attempt` (from 0). */
export function retryDelayMs(attempt: number): number {
  return Math.min(FIRST_RETRY_MS * 2 ** attempt, LONGEST_RETRY_MS);
}

/**
 * Calls `act(true)` once the next frame is being drawn, or `act(false)` in a hidden window: there at once, because
 * browsers slow a hidden page's timers down, and whoever is in charge counts as gone after a second of silence.
 */
function afterDrawing(act: (isDrawn: boolean) => void): void {
  if (document.hidden) {
    act(false);
    return;
  }
  let done = false;
  const once = (isDrawn: boolean) => {
    if (!done) act(isDrawn);
    done = true;
  };
  requestAnimationFrame(() => once(true));
  setTimeout(() => once(false), LATEST_ACK_MS);
}

/**
 * Follows the stream until closed, connecting again by itself whenever it breaks.
 *
 * `onMessage` gets each message as it arrives and should only keep it: draw in `requestAnimationFrame`. The message is
 * acknowledged in the animation frame that follows, and the service sends the then newest one. So a slow screen skips
 * ticks and is never shown stale ones.
 */
export function connectLive(
  screen: Screen,
  onMessage: (message: LiveMessage) => void,
  onLink: (link: Link) => void = () => {},
): LiveConnection {
  let socket: WebSocket | null = null;
  let retry: ReturnType<typeof setTimeout> | undefined;
  let attempt = 0;
  let closed = false;

  const acknowledge = (from: WebSocket, index: number, isDrawn: boolean) => {
    if (from.readyState !== WebSocket.OPEN) return;
    from.send(JSON.stringify({ ack: index, drawn_on: isDrawn ? screen : null }));
  };
  const receive = (from: WebSocket, text: string) => {
    const message = JSON.parse(text) as LiveMessage;
    onMessage(message);
    afterDrawing((isDrawn) => acknowledge(from, message.tick.index, isDrawn));
  };
  const open = () => {
    const mine = new WebSocket(streamAddress(new URL(location.href), clientId()));
    socket = mine;
    mine.onopen = () => {
      attempt = 0;
      onLink("open");
    };
    mine.onmessage = (event) => receive(mine, String(event.data));
    mine.onclose = ({ code }) => {
      if (closed) return;
      if (code === OPENED_ELSEWHERE) renewClientId();
      onLink("lost");
      retry = setTimeout(open, retryDelayMs(attempt++));
    };
  };

  onLink("connecting");
  open();
  return {
    close: () => {
      closed = true;
      clearTimeout(retry);
      socket?.close();
    },
  };
}
