// The keys that stop the arm, heard in the page and in the 3-D view inside it.
import { useEffect } from "preact/hooks";

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

/** Escape stops the arm wherever the focus is; Space does too, except where it writes a space. */
export function isStopKey(event: Pick<KeyboardEvent, "key" | "target">): boolean {
  if (event.key === "Escape") return true;
  return event.key === " " && !isWriting(event.target);
}

/** Inputs that a person types no text into: there Space is a stop like anywhere else. */
const WORDLESS = new Set(["range", "radio", "checkbox", "button", "submit", "number"]);

function isWriting(target: EventTarget | null): boolean {
  const { tagName, type, isContentEditable } = (target ?? {}) as Partial<HTMLInputElement>;
  if (tagName === "TEXTAREA" || isContentEditable) return true;
  return tagName === "INPUT" && !WORDLESS.has(type ?? "text");
}
