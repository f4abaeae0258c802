import { describe, expect, it } from "vitest";
import type { LiveMessage } from "../api/types";
import { Turn } from "./one-sound";

const message = (patient_screens: number | null): LiveMessage =>
  ({ session: patient_screens === null ? null : { id: 1, patient_screens } }) as unknown as LiveMessage;

/** What is said after messages with these counts, a second apart. */
function heard(...counts: readonly (number | null)[]): boolean[] {
  const turn = new Turn();
  return counts.map((count, i) => turn.take(message(count), i));
}

describe("Turn", () => {
  it("leaves the sound to a screen that was there before", () => {
    expect(heard(1, 2, 2, 2, 2)).toEqual([true, true, true, true, true]);
  });

  it("sounds where it is alone, also once it is counted itself, and goes on when a second one comes", () => {
    expect(heard(0, 1, 1, 2, 2)).toEqual([false, false, false, false, false]);
  });

  it("takes over when the other one has gone", () => {
    expect(heard(1, 2, 2, 2, 1, 1).at(-1)).toBe(false);
  });

  it("was there first where it saw the session being opened", () => {
    expect(heard(null, 2, 2)).toEqual([false, false, false]);
  });
});
