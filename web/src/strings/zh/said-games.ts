// What the service says of games, plans and workspaces in words of its own, in Chinese; read with `said.ts`.

const PHASES: Readonly<Record<string, string>> = {
  waiting: "等待开始",
  playing: "进行中",
  rest: "休息中",
  paused: "已暂停",
  between: "两项之间",
  over: "已结束",
};
const WISHES: Readonly<Record<string, string>> = {
  start: "开始",
  pause: "暂停",
  go_on: "继续",
  rest: "休息",
  next: "下一项",
  quit: "退出",
  pin: "固定难度",
  adapt: "自动难度",
};

/** A wish of every kind in every phase that refuses it. */
const NOT_POSSIBLE: readonly [RegExp, string][] = Object.entries(WISHES).flatMap(([wish, wanted]) =>
  Object.entries(PHASES).map(([phase, stands]): [RegExp, string] => [
    new RegExp(`^'${wish}' is not possible while the game is ${phase}$`),
    `游戏${stands}时不能“${wanted}”`,
  ]),
);

export const CHINESE_OF_GAMES: readonly [RegExp, string][] = [
  ...NOT_POSSIBLE,
  [/^a game that is (?:waiting|playing|rest|paused|between|over)(?: or \w+)*$/, "游戏处于可以这样做的阶段"],
  [/^look how the game stands$/, "请看游戏目前的状态"],
  [/^the games have not begun$/, "游戏尚未开始"],
  [/^an arm that has been engaged once$/, "手臂至少启动过一次"],
  [/^start the arm; the first game follows$/, "请先启动手臂，第一个游戏随后开始"],
  [/^there is no further exercise$/, "没有下一项练习了"],
  [/^a session with one more$/, "还有下一项练习的治疗"],
  [/^quit the game, or go on with it$/, "请退出游戏或继续"],
  [/^the games have begun$/, "游戏已经开始"],
  [/^a workspace measured before$/, "在游戏开始前测量活动范围"],
  [/^it stays as it is this time$/, "本次治疗保持现有范围"],
  [
    /^the healthy arm has not shown enough yet \(too little movement: .+\)$/,
    "健侧手臂展示得还不够（有的关节活动太少）",
  ],
  [/^the healthy arm has not shown enough yet \(too short a time\)$/, "健侧手臂展示得还不够（时间太短）"],
  [/^every joint moved as far as is comfortable$/, "每个关节都活动到舒适的最大范围"],
  [/^let the patient go on showing$/, "请让患者继续展示"],
  [/^there is no game '(.+)'$/, "没有名为“{1}”的游戏"],
  [/^one of [a-z]+(?:, [a-z]+)*$/, "现有的游戏之一"],
  [
    /^choose one of these; where the patient's plan names it, change the plan$/,
    "请另选；若患者的计划里有它，请修改计划",
  ],
  [/^(.+) has no plan yet$/, "{1} 还没有计划"],
  [/^a plan$/, "一份计划"],
  [/^make one on the patient's page$/, "请在患者页面制定"],
  [/^the patient's screen has gone; the game waits$/, "患者屏幕已断开，游戏等待"],
  [/^(\d+) of the patient's screens are there$/, "患者屏幕数：{1}"],
  [/^measured with the healthy arm$/, "已用健侧手臂测量"],
  [/^the form: value error, the scale of [a-z-]+ ends at (\d+)$/, "该评分最高为 {1}"],
  [/^the form: value error, the day of the test is still to come$/, "测试日期还没有到"],
  [/^the program made a mistake in a game: (.+)$/, "游戏程序出错：{1}"],
  [/^the form: value error, the plan begins more than a year from now$/, "计划的开始日期在一年以后"],
];
