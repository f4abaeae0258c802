import { expect, test } from "vitest";
import { chargeOf } from "./charge";

const me = { account: "lin", client: "a1" };

test("one page of one account is in charge", () => {
  expect(chargeOf({ account: "lin", client: "a1", connected: true }, me)).toBe("mine");
  expect(chargeOf({ account: "lin", client: "b2", connected: true }, me)).toBe("other");
  expect(chargeOf({ account: "wang", client: "a1", connected: true }, me)).toBe("other");
});

test("whoever is in charge but not there is gone, and so is nobody", () => {
  expect(chargeOf({ account: "wang", client: "b2", connected: false }, me)).toBe("gone");
  expect(chargeOf(null, me)).toBe("gone");
});
