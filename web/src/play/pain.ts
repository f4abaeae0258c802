// The patient's own stop: one large button, one key, one act. The arm is then carried softly, and only the therapist goes on.
import { Problem } from "../api/client";
import type { LiveMessage } from "../api/types";
import { sendUrgent } from "../api/urgent";
import { onLanguage, t } from "../strings";
import { child, setText } from "./dom";

/** `still`: the service answered that the arm does not move, so there was nothing to stop. */
export type PainShown = "idle" | "sent" | "done" | "still" | "unanswered";

const SHOWN_MS = 6000;
const OCTAGON = "M12 2 H28 L38 12 V28 L28 38 H12 L2 28 V12 Z M10 17 V23 H30 V17 Z";

export class Pain {
  private readonly button: HTMLButtonElement;
  private readonly word: HTMLElement;
  private readonly hint: HTMLElement;
  private readonly spoken: HTMLElement;
  private session: number | null = null;
  private shown: PainShown = "idle";
  private presses = 0;

  constructor(root: HTMLElement) {
    this.button = child(root, "button", "pain");
    this.button.type = "button";
    this.button.dataset.testid = "pain";
    this.button.hidden = true;
    this.button.insertAdjacentHTML(
      "afterbegin",
      `<svg viewBox="0 0 40 40" aria-hidden="true"><path d="${OCTAGON}" fill="currentColor" fill-rule="evenodd"/></svg>`,
    );
    const words = child(this.button, "span", "pain-words");
    this.word = child(words, "span", "pain-word");
    this.hint = child(words, "span", "pain-hint");
    this.spoken = child(root, "span", "spoken");
    this.spoken.setAttribute("role", "status");
    // Going down is enough, wherever the finger slips to; a click without it comes from assistive technology.
    this.button.addEventListener("pointerdown", () => this.press());
    this.button.addEventListener("click", (event) => event.detail === 0 && this.press());
    window.addEventListener("keydown", (event) => this.hear(event), true);
    onLanguage(() => this.name());
    this.name();
  }

  /** There is something to stop only while a session is open. */
  take({ session }: LiveMessage): void {
    this.session = session?.id ?? null;
    this.button.hidden = this.session === null;
  }

  private hear(event: KeyboardEvent): void {
    if (this.session === null || !isPainKey(event)) return;
    event.preventDefault();
    event.stopPropagation();
    if (!event.repeat) this.press();
  }

  private press(): void {
    if (this.session === null) return;
    this.presses += 1;
    const mine = this.presses;
    const show = (next: PainShown) => mine === this.presses && this.show(next);
    show("sent");
    sendUrgent(this.session, "pain")
      .then(() => show("done"))
      .catch((error: unknown) => show(failed(error)))
      .finally(() => setTimeout(() => this.shown !== "unanswered" && show("idle"), SHOWN_MS));
  }

  private show(next: PainShown): void {
    this.shown = next;
    this.name();
  }

  private name(): void {
    this.button.dataset.shown = this.shown;
    setText(this.word, t(this.shown === "idle" ? "play.pain" : `play.pain.${this.shown}`));
    setText(this.hint, this.shown === "idle" ? t("play.pain.keys") : "");
    setText(this.spoken, this.shown === "idle" ? "" : t(`play.pain.${this.shown}`));
  }
}

/** A switch that a patient can reach sends one of these; Enter also presses the therapist's small buttons. */
export function isPainKey({ key, target }: Pick<KeyboardEvent, "key" | "target">): boolean {
  if (key === " " || key === "Escape") return true;
  const { tagName } = (target ?? {}) as Partial<HTMLElement>;
  return key === "Enter" && tagName !== "BUTTON" && tagName !== "A";
}

function failed(error: unknown): PainShown {
  return error instanceof Problem && error.status !== 0 ? "still" : "unanswered";
}
