// The figures at the rim of the picture: points, series, round, time left. Large, and spoken by screen readers.
import { t } from "../strings";
import type { Changes, GameView } from "./changes";
import { child, setText } from "./dom";
import { clockText, type Face } from "./screen";

const POPUP_MS = 1100;
const LONGEST_ROW = 3;

export class Hud {
  private readonly figures: HTMLElement;
  private readonly score: HTMLElement;
  private readonly scoreLabel: HTMLElement;
  private readonly streak: HTMLElement;
  private readonly round: HTMLElement;
  private readonly exercise: HTMLElement;
  private readonly time: HTMLElement;
  private readonly timeLabel: HTMLElement;
  private readonly spoken: HTMLElement;

  constructor(private readonly root: HTMLElement) {
    this.figures = child(root, "div", "rim");
    this.figures.hidden = true;
    const left = child(this.figures, "div", "figures figures-left");
    this.scoreLabel = child(left, "div", "label");
    this.score = child(left, "div", "number");
    this.score.dataset.testid = "score";
    this.streak = child(left, "div", "streak");
    const right = child(this.figures, "div", "figures figures-right");
    this.timeLabel = child(right, "div", "label");
    this.time = child(right, "div", "number");
    this.time.dataset.testid = "time-left";
    this.round = child(right, "div", "round");
    this.exercise = child(right, "div", "exercise");
    this.exercise.dataset.testid = "exercise";
    this.spoken = child(root, "div", "spoken");
    this.spoken.setAttribute("aria-live", "polite");
  }

  /** Beside a face that says what comes next the figures would only disturb. */
  show(view: GameView | null, face: Face): void {
    this.figures.hidden = view === null || face !== "playing";
    if (!view || this.figures.hidden) return;
    setText(this.scoreLabel, t("play.score"));
    setText(this.score, String(view.total_score));
    setText(this.timeLabel, t("play.time"));
    setText(this.time, clockText(view.time_left_s));
    setText(this.round, t("play.round", { round: view.round, rounds: view.rounds }));
    setText(
      this.exercise,
      view.exercises > 1 ? t("play.exercise", { exercise: view.exercise, exercises: view.exercises }) : "",
    );
    setText(
      this.streak,
      view.streak > 1 ? `${"●".repeat(Math.min(view.streak, LONGEST_ROW))} ${streakText(view)}` : "",
    );
  }

  /** Lets a screen reader say the points after a hit. */
  announce(changes: Changes, view: GameView): void {
    if (changes.hits > 0) setText(this.spoken, t("play.said.score", { score: view.total_score }));
  }

  /** Lets the points just won rise from where the fruit was, in pixels of the page. */
  popUp(points: number, at: { x: number; y: number }): void {
    if (points <= 0) return;
    const popup = child(this.root, "div", "popup");
    popup.textContent = `+${points}`;
    popup.style.left = `${at.x}px`;
    popup.style.top = `${at.y}px`;
    setTimeout(() => popup.remove(), POPUP_MS);
  }
}

function streakText(view: GameView): string {
  return t("play.streak", { count: view.streak });
}
