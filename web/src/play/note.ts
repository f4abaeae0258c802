// The short note above the game: a picture and one sentence, kindly.
import { type Key, t } from "../strings";
import { gameName, howToPlay } from "../strings/games";
import { child, setText } from "./dom";

import type { Note } from "./note-for";

/** A person seen from the side against a backrest, and shoulders that sink; drawn in strokes, so that nothing hangs on colour. */
const PICTURES: Partial<Record<Note["kind"], string>> = {
  lean: '<path d="M14 8v44h26v-18M14 52v6M40 52v6M24 46V26M24 46h14v8"/><circle cx="24" cy="17" r="6"/><path d="M52 20H36m7-7-7 7 7 7"/>',
  hitch:
    '<circle cx="32" cy="16" r="8"/><path d="M8 54V44q0-10 10-10h28q10 0 10 10v10M11 12v14m-6-6 6 6 6-6M53 12v14m-6-6 6 6 6-6"/>',
};

export class NoteBoard {
  private readonly board: HTMLElement;
  private readonly picture: HTMLElement;
  private readonly words: HTMLElement;
  private kind: Note["kind"] | null = null;

  constructor(root: HTMLElement) {
    this.board = child(root, "div", "note");
    this.board.setAttribute("role", "status");
    this.board.dataset.testid = "note";
    this.board.hidden = true;
    this.picture = child(this.board, "span", "note-picture");
    this.words = child(this.board, "span", "note-words");
  }

  show(note: Note | null): void {
    this.board.hidden = note === null;
    if (!note) return;
    setText(this.words, wordsOf(note));
    if (note.kind === this.kind) return;
    this.kind = note.kind;
    this.board.dataset.kind = note.kind;
    const drawing = PICTURES[note.kind];
    this.picture.innerHTML = drawing ? `<svg viewBox="0 0 64 64" aria-hidden="true">${drawing}</svg>` : "";
  }
}

function wordsOf(note: Note): string {
  if (note.kind === "help") return t(`play.help.${note.mode}`);
  if (note.kind === "game") return `${gameName(note.game)}: ${howToPlay(note.game)}`;
  return t(NOTE_KEYS[note.kind]);
}

const NOTE_KEYS: Record<"lean" | "hitch" | "screens" | "tired", Key> = {
  lean: "play.posture.lean",
  hitch: "play.posture.hitch",
  screens: "play.screens",
  tired: "play.tired",
};
