import { describe, expect, it } from "vitest";
import type { LiveMessage } from "../api/types";
import { LEAVE_S, visitAfter } from "./visit";

const message = (session: number | null, total_score: number | null): LiveMessage =>
  ({
    session: session === null ? null : { id: session },
    game: total_score === null ? null : { total_score },
  }) as unknown as LiveMessage;

describe("visitAfter", () => {
  it("keeps the points of a session that was closed half-way", () => {
    const played = visitAfter(null, message(1, 70), 0);
    expect(visitAfter(played, message(null, null), 10)).toMatchObject({
      session: 1,
      points: 70,
      until_s: 10 + LEAVE_S,
    });
  });

  it("forgets them after a while, and at once when another session is opened", () => {
    const left = visitAfter(visitAfter(null, message(1, 70), 0), message(null, null), 10);
    expect(visitAfter(left, message(null, null), 11 + LEAVE_S)).toBeNull();
    expect(visitAfter(left, message(2, null), 20)).toBeNull();
  });

  it("has nothing to remember where nothing was played", () => {
    expect(visitAfter(visitAfter(null, message(1, null), 0), message(null, null), 1)).toBeNull();
  });
});
