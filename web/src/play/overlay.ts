// The panel in the middle: one plain sentence when there is nothing to play, a breathing picture in the rest.
import { type Key, t } from "../strings";
import type { GameView } from "./changes";
import { child, setText } from "./dom";
import { clockText, type Face } from "./screen";

/** One breath in and one out; slow breathing at six a minute. */
const BREATH_S = 10;

export class Overlay {
  private readonly panel: HTMLElement;
  private readonly title: HTMLElement;
  private readonly text: HTMLElement;
  private readonly reason: HTMLElement;
  private readonly breath: HTMLElement;
  private readonly breathWord: HTMLElement;
  private readonly countdown: HTMLElement;
  private readonly login: HTMLAnchorElement;

  constructor(private readonly root: HTMLElement) {
    this.panel = child(root, "div", "panel");
    this.panel.setAttribute("role", "status");
    this.title = child(this.panel, "h1", "title");
    this.text = child(this.panel, "p", "text");
    this.reason = child(this.panel, "p", "reason");
    this.login = child(this.panel, "a", "login");
    this.login.href = "/";
    this.breath = child(root, "div", "breath");
    this.breath.setAttribute("aria-hidden", "true");
    child(this.breath, "div", "breath-ring");
    child(this.breath, "div", "breath-ball");
    this.breathWord = child(this.breath, "div", "breath-word");
    this.countdown = child(root, "div", "countdown");
    this.countdown.dataset.testid = "countdown";
  }

  /** Shows the face; `reason` is a further sentence for it, if there is one. */
  show(face: Face, game: GameView | null, reason: Key | null, now_s: number): void {
    this.root.hidden = face === "playing";
    this.root.dataset.face = face;
    if (face === "playing") return;
    setText(this.title, t(`play.${face}.title`));
    setText(this.text, t(`play.${face}.text`, { hits: game?.hits ?? 0, score: game?.score ?? 0 }));
    setText(this.reason, reason ? t(reason) : "");
    setText(this.login, face === "locked" ? t("play.locked.link") : "");
    this.showRest(face === "rest", game, now_s);
  }

  private showRest(resting: boolean, game: GameView | null, now_s: number): void {
    this.breath.hidden = !resting;
    this.countdown.hidden = !resting;
    if (!resting) return;
    const word: Key = now_s % BREATH_S < BREATH_S / 2 ? "play.breathe.in" : "play.breathe.out";
    setText(this.breathWord, t(word));
    this.breath.style.setProperty("--breath", breathFullness(now_s).toFixed(3));
    setText(this.countdown, t("play.rest.left", { time: clockText(game?.time_left_s ?? 0) }));
  }
}

/** How full the lungs are, 0..1, at a moment. */
export function breathFullness(now_s: number): number {
  return (1 - Math.cos((2 * Math.PI * now_s) / BREATH_S)) / 2;
}
