import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { Problem } from "./client";
import { sendUrgent } from "./urgent";

const silence = () => Promise.reject(new Problem(0, { what: "no answer", expected: "", remedy: "" }));
const refusal = () => Promise.reject(new Problem(409, { what: "not open", expected: "", remedy: "" }));
const answer = () => Promise.resolve({ state: "stopped", reason: "" } as const);

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

describe("a wish that must arrive", () => {
  test("is sent again while nobody answers", async () => {
    const ask = vi.fn(answer).mockImplementationOnce(silence).mockImplementationOnce(silence);
    const sent = sendUrgent(7, "stop", ask);
    await vi.runAllTimersAsync();
    await expect(sent).resolves.toBeUndefined();
    expect(ask).toHaveBeenCalledTimes(3);
  });

  test("is given up after the fourth silence", async () => {
    const ask = vi.fn(silence);
    const sent = expect(sendUrgent(7, "pain", ask)).rejects.toThrow("no answer");
    await vi.runAllTimersAsync();
    await sent;
    expect(ask).toHaveBeenCalledTimes(4);
  });

  test("is not repeated where it was refused", async () => {
    const ask = vi.fn(refusal);
    await expect(sendUrgent(7, "pain", ask)).rejects.toThrow("not open");
    expect(ask).toHaveBeenCalledTimes(1);
  });
});
