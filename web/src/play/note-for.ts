// Which of the short notes above the game is shown: one at a time, the most important first.
import type { Assistance, LiveMessage } from "../api/types";
import type { Face } from "./screen";

export type Note =
  | { readonly kind: "help"; readonly mode: Assistance }
  | { readonly kind: "lean" | "hitch" | "screens" | "tired" }
  | { readonly kind: "game"; readonly game: string };

const SHOWN_S = 7;
/** A posture that is right again is told a moment longer, so that the note can be read. */
const POSTURE_S = 3;

interface Told {
  readonly note: Note;
  readonly until_s: number;
}

/** Remembers what was new and for how long it is told. */
export class Notes {
  private readonly told = new Map<Note["kind"], Told>();
  private before: LiveMessage | null = null;

  /** Takes a message that came at `now_s`. What the first of a session says is no change. */
  take(message: LiveMessage, now_s: number): void {
    const before = this.before?.session?.id === message.session?.id ? this.before : null;
    this.before = message;
    if (!message.session) this.told.clear();
    for (const note of news(before, message)) this.tell(note, now_s + SHOWN_S);
    const posture = message.game?.posture;
    if (posture === "lean" || posture === "hitch") this.tell({ kind: posture }, now_s + POSTURE_S);
  }

  /** The note to show; while words fill the screen none but that of two screens, which concerns the therapist. */
  at(now_s: number, face: Face): Note | null {
    const kinds: readonly Note["kind"][] =
      face === "playing" ? ["help", "lean", "hitch", "game", "tired", "screens"] : ["screens"];
    for (const kind of kinds) {
      const told = this.told.get(kind);
      if (told && told.until_s > now_s) return told.note;
    }
    return null;
  }

  private tell(note: Note, until_s: number): void {
    this.told.set(note.kind, { note, until_s });
  }
}

function news(before: LiveMessage | null, { tick, game, session }: LiveMessage): Note[] {
  const notes: Note[] = [];
  const mode = tick.exo.assistance;
  const modeBefore = before?.tick.exo.assistance;
  if (mode && modeBefore && mode !== modeBefore) notes.push({ kind: "help", mode });
  if ((session?.patient_screens ?? 0) > Math.max(1, before?.session?.patient_screens ?? 1))
    notes.push({ kind: "screens" });
  if (game?.rest_suggested && before?.game && !before.game.rest_suggested) notes.push({ kind: "tired" });
  if (game && before?.game && game.exercise > before.game.exercise) notes.push({ kind: "game", game: game.game });
  return notes;
}
