// Wishes that must arrive: a stop, and the patient's word that it hurts. Sent again until somebody answers.
import { control, Problem } from "./client";

export type Urgent = "stop" | "pain";

const ATTEMPTS = 4;
const BETWEEN_ATTEMPTS_MS = 150;
const PATIENCE_MS = 1500;

/** Sends it; one that got no answer is sent again at once, a refusal is not. */
export async function sendUrgent(session: number, action: Urgent, ask: typeof control = control): Promise<void> {
  for (let attempt = 1; ; attempt += 1) {
    try {
      await ask(session, action, PATIENCE_MS);
      return;
    } catch (error) {
      const answered = error instanceof Problem && error.status !== 0;
      if (answered || attempt >= ATTEMPTS) throw error;
      await new Promise((resolve) => setTimeout(resolve, BETWEEN_ATTEMPTS_MS));
    }
  }
}

/** What a person sees of a wish that must arrive: at once that it was sent, then that it was done. */
export type Progress = "idle" | "sent" | "done" | "unanswered";
