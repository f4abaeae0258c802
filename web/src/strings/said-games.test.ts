import { expect, test } from "vitest";
import { inChinese } from "./said";

const SENTENCES = [
  "'rest' is not possible while the game is paused",
  "'go_on' is not possible while the game is over",
  "a game that is between or paused or rest or waiting",
  "the games have not begun",
  "there is no further exercise",
  "the healthy arm has not shown enough yet (too little movement: rotation, elbow)",
  "the healthy arm has not shown enough yet (too short a time)",
  "one of catch, everyday, reach",
  "choose one of these; where the patient's plan names it, change the plan",
  "the patient's screen has gone; the game waits",
  "measured with the healthy arm",
];

test.each(SENTENCES)("the service's sentence is said in Chinese: %s", (sentence) => {
  expect(inChinese(sentence)).not.toMatch(/[a-z]/i);
});

test("names and numbers are carried over", () => {
  expect(inChinese("Wang has no plan yet")).toBe("Wang 还没有计划");
  expect(inChinese("there is no game 'skittles'")).toBe("没有名为“skittles”的游戏");
  expect(inChinese("2 of the patient's screens are there")).toBe("患者屏幕数：2");
});
