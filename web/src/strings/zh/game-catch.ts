// 接住。
import type { gameCatch as english } from "../en/game-catch";

export const gameCatch: Record<keyof typeof english, string> = {
  "game.catch": "迎蝴蝶",
  "game.catch.aim": "时机与预判：在对的时刻到对的地方",
  "game.catch.how": "在蝴蝶飞来之前把手放进圆环，它就会落在您的手上。",
};
