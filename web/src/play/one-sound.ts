// Where a patient's game is shown on several screens, only one of them makes sounds: the one that was there first.
import type { LiveMessage } from "../api/types";

/** By then the service has counted this page among the screens. */
const COUNTED_S = 3;
const LOCK = "mirrorlimb.sound";

/** Tells whether this page came to a session that another screen showed already. */
export class Turn {
  private second = false;
  private since_s: number | null = null;
  private sawNone = false;

  /** Takes a message that came at `now_s`; true while another screen makes the sounds. */
  take({ session }: LiveMessage, now_s: number): boolean {
    if (!session) {
      this.sawNone = true;
      this.since_s = null;
      this.second = false;
      return false;
    }
    // A page is counted once it has answered: what the first message counts are the others.
    if (this.since_s === null) {
      this.since_s = now_s;
      this.second = session.patient_screens > 0 && !this.sawNone;
    } else if (session.patient_screens <= 1 && now_s - this.since_s > COUNTED_S) {
      this.second = false;
    }
    return this.second;
  }
}

/** Calls `whenFirst` once no other window of this browser makes sounds; at once where it cannot tell (plain http). */
export function waitForTurn(whenFirst: () => void): void {
  if (!navigator.locks) {
    whenFirst();
    return;
  }
  void navigator.locks.request(LOCK, () => {
    whenFirst();
    return new Promise(() => {}); // held until the window is closed
  });
}
