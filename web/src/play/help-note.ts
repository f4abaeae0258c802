// A short note where the therapist changes how the exoskeleton helps, in words for the patient.
import type { Assistance, LiveMessage } from "../api/types";
import { t } from "../strings";
import { child, setText } from "./dom";
import type { Face } from "./screen";

const SHOWN_S = 7;

export class HelpNote {
  private readonly note: HTMLElement;
  private before: Assistance | null = null;
  private told: Assistance | null = null;
  private until_s = 0;

  constructor(root: HTMLElement) {
    this.note = child(root, "div", "help-note");
    this.note.setAttribute("role", "status");
    this.note.dataset.testid = "help-note";
  }

  /** The first message of a session is no change. */
  take({ tick, session }: LiveMessage, now_s: number): void {
    const mode = session ? (tick.exo.assistance ?? null) : null;
    if (mode && this.before && mode !== this.before) {
      this.told = mode;
      this.until_s = now_s + SHOWN_S;
    }
    this.before = mode;
  }

  /** Beside a face that says more it would only disturb. */
  show(face: Face, now_s: number): void {
    this.note.hidden = face !== "playing" || now_s > this.until_s;
    if (this.told && !this.note.hidden) setText(this.note, t(`play.help.${this.told}`));
  }
}
