import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { clientId, keyOf, renewClientId } from "./client-id";

beforeEach(() => {
  const kept = new Map<string, string>();
  vi.stubGlobal("location", { pathname: "/" });
  vi.stubGlobal("sessionStorage", {
    getItem: (key: string) => kept.get(key) ?? null,
    setItem: (key: string, value: string) => kept.set(key, value),
  });
});
afterEach(() => vi.unstubAllGlobals());

test("a page stays itself until it must become another", () => {
  const first = clientId();
  expect(first).toMatch(/^[A-Za-z0-9_-]{32}$/);
  expect(clientId()).toBe(first);
  expect(renewClientId()).not.toBe(first);
  expect(clientId()).not.toBe(first);
});

test("the patient's screen is not the dashboard that opened it", () => {
  expect(keyOf("/play.html")).not.toBe(keyOf("/"));
});
