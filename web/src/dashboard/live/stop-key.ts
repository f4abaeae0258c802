// The keys that stop the arm, heard in the page and in the 3-D view inside it.
import { useEffect } from "preact/hooks";
import { isStopKey } from "./actions";

/** Calls `stop` on each stop key; returns how to listen in a further window, such as a frame's. */
export function useStopKey(stop: () => void): (inside: Window | null) => void {
  const heard = (event: KeyboardEvent) => {
    if (!isStopKey(event)) return;
    event.preventDefault();
    event.stopPropagation();
    if (event.type === "keydown" && !event.repeat) stop();
  };
  const listenIn = (target: Window) => {
    // keyup too: a focused button would be pressed by the space bar's release.
    target.addEventListener("keydown", heard, true);
    target.addEventListener("keyup", heard, true);
    return () => {
      target.removeEventListener("keydown", heard, true);
      target.removeEventListener("keyup", heard, true);
    };
  };
  useEffect(() => listenIn(window));
  return (inside) => {
    if (inside) listenIn(inside);
  };
}
