import { expect, test } from "vitest";
import { inChinese, said } from "./said";

test("English stays as the service said it, without the full stop", () => {
  expect(said("No sensor is aligned yet.")).toBe("No sensor is aligned yet");
});

test("a known sentence is said in Chinese, whatever stands at its head", () => {
  expect(inChinese("No session is open")).toBe("没有进行中的治疗");
  expect(inChinese("no session is open")).toBe("没有进行中的治疗");
});

test("blanks are carried over", () => {
  expect(inChinese("Dr. Lin pressed stop")).toBe("Dr. Lin 按了“停止”");
  expect(inChinese("Li's affected side is the left, not the right")).toContain("Li");
});

test("each of several sentences is said in Chinese", () => {
  expect(inChinese("No sensor sees the patient now. A person resumes")).toBe("目前没有传感器看到患者；请由人按“继续”");
});

test("angles are said in degrees", () => {
  expect(said("(elbow by 1.1 rad); bring it near.")).toBe("(elbow by 63°); bring it near");
});

test("an unknown sentence is not lost", () => {
  expect(inChinese("The moon is full")).toBe("The moon is full");
});

test("who is in charge, resistance and pain are said in Chinese", () => {
  expect(inChinese("The elbow resists with 7.1 N m; the arm is held softly")).toContain("7.1 Nm");
  expect(inChinese("Nobody who is in charge is connected")).toBe("控制者的页面已断开");
  expect(inChinese("another page of yours is in charge of the arm")).toBe("您正在另一页面控制");
  expect(inChinese("wang is in charge of the arm")).toBe("目前由 wang 控制");
  expect(inChinese("Enable is not possible while the exoskeleton is 'hold'")).not.toContain("hold");
});
