import { describe, expect, test } from "vitest";
import { retryDelayMs, streamAddress } from "./live";

describe("the stream", () => {
  test("is where the page came from, encrypted where the page was", () => {
    expect(streamAddress(new URL("http://127.0.0.1:8000/#/live"), "a1")).toBe(
      "ws://127.0.0.1:8000/api/stream?client=a1",
    );
    expect(streamAddress(new URL("https://station.example/play.html"), "b2")).toBe(
      "wss://station.example/api/stream?client=b2",
    );
  });

  test("is tried again soon at first, then patiently, never rarely", () => {
    const delays = Array.from({ length: 12 }, (_, attempt) => retryDelayMs(attempt));
    expect(delays[0]).toBeLessThan(500);
    expect(delays).toEqual([...delays].sort((a, b) => a - b));
    expect(Math.max(...delays)).toBeLessThanOrEqual(3000);
  });
});
