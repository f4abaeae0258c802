import { afterEach, expect, test, vi } from "vitest";
import { STALE_S } from "../../api/live";
import type { LiveMessage } from "../../api/types";
import { Feed } from "./feed";

const message = {
  tick: { t_s: 1, healthy: null, affected: { valid: false }, exo: { clamped: ["elbow: held"] } },
} as unknown as LiveMessage;

afterEach(() => vi.useRealTimers());

test("a service that hangs behind an open connection counts as lost until it speaks again", () => {
  vi.useFakeTimers();
  const feed = new Feed();
  feed.connection = "open";
  expect(feed.link).toBe("open");
  feed.take(message);
  vi.advanceTimersByTime(STALE_S * 1000 - 50);
  expect(feed.link).toBe("open");
  vi.advanceTimersByTime(100);
  expect(feed.link).toBe("lost");
  feed.take(message);
  expect(feed.link).toBe("open");
});

test("what was clamped in one tick can still be read", () => {
  vi.useFakeTimers();
  const feed = new Feed();
  feed.take(message);
  vi.advanceTimersByTime(1000);
  expect(feed.clampedLately()).toEqual(["elbow: held"]);
  vi.advanceTimersByTime(3000);
  expect(feed.clampedLately()).toEqual([]);
});
