// 首页：今天该治疗的患者。
import type { today as english } from "../en/today";

export const today: Record<keyof typeof english, string> = {
  "today.title": "今天，{day}",
  "today.open": "有治疗正在进行",
  "today.due": "今天应治疗：{count} 人",
  "today.due.none": "按计划今天没有治疗。",
  "today.others": "其他患者",
  "today.all": "患者",
  "today.search": "查找患者",
  "today.nobody": "没有姓名含“{name}”的患者。",
  "today.start.for": "开始治疗：{name}",
  "today.minutes": "{minutes} 分钟",
  "today.week": "本周 {done}/{planned} 次",
  "today.last": "上次治疗 {day}，游戏 {minutes} 分钟",
  "today.last.none": "尚无治疗",
  "today.plan.none": "尚无计划：治疗从一个游戏六分钟开始。",
  "today.plan.later": "计划尚未开始",
  "today.plan.over": "计划已结束",
  "today.plan.week": "第 {week}/{weeks} 周",
  "today.limits": "查看并确认",
};
