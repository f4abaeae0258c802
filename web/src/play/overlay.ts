// The panel: one plain sentence when there is nothing to play, what comes next, a breathing picture in the rest.
import { type Key, t } from "../strings";
import { child, setData, setText } from "./dom";
import type { Face } from "./screen";
import { type Known, wordsFor } from "./words";

/** One breath in and one out; slow breathing at six a minute. */
const BREATH_S = 10;

export class Overlay {
  private readonly title: HTMLElement;
  private readonly text: HTMLElement;
  private readonly points: HTMLElement;
  private readonly reason: HTMLElement;
  private readonly breath: HTMLElement;
  private readonly breathWord: HTMLElement;
  private readonly countdown: HTMLElement;
  private readonly login: HTMLAnchorElement;

  constructor(private readonly root: HTMLElement) {
    const panel = child(root, "div", "panel");
    this.breath = child(panel, "div", "breath");
    this.breath.setAttribute("aria-hidden", "true");
    child(this.breath, "div", "breath-ring");
    child(this.breath, "div", "breath-ball");
    this.breathWord = child(this.breath, "div", "breath-word");
    const words = child(panel, "div", "words");
    words.setAttribute("role", "status");
    this.title = child(words, "h1", "title");
    this.text = child(words, "p", "text");
    this.points = child(words, "p", "points");
    this.points.dataset.testid = "total";
    this.reason = child(words, "p", "reason");
    this.login = child(words, "a", "login");
    this.login.href = "/";
    // Outside what is read aloud, or it would be said anew every second.
    this.countdown = child(panel, "div", "countdown");
    this.countdown.dataset.testid = "countdown";
  }

  /** Shows the face; `reason` is a further sentence for it, if there is one. */
  show(face: Face, known: Known, reason: Key | null, now_s: number): void {
    this.root.hidden = face === "playing";
    setData(this.root, "face", face);
    if (face === "playing") return;
    const words = wordsFor(face, known);
    setText(this.title, words.title);
    setText(this.text, words.text);
    setText(this.points, words.points === null ? "" : t("play.points", { points: words.points }));
    setText(this.reason, reason ? t(reason) : "");
    setText(this.login, face === "locked" ? t("play.locked.link") : "");
    setText(this.countdown, words.countdown);
    this.breathe(face === "rest", now_s);
  }

  private breathe(resting: boolean, now_s: number): void {
    this.breath.hidden = !resting;
    if (!resting) return;
    const word: Key = now_s % BREATH_S < BREATH_S / 2 ? "play.breathe.in" : "play.breathe.out";
    setText(this.breathWord, t(word));
    this.breath.style.setProperty("--breath", breathFullness(now_s).toFixed(3));
  }
}

/** How full the lungs are, 0..1, at a moment. */
export function breathFullness(now_s: number): number {
  return (1 - Math.cos((2 * Math.PI * now_s) / BREATH_S)) / 2;
}
