// 日常动作。
import type { gameEveryday as english } from "../en/game-everyday";

export const gameEveryday: Record<keyof typeof english, string> = {
  "game.everyday": "早餐桌",
  "game.everyday.aim": "日常动作：屈肘、拿稳、一步接一步",
  "game.everyday.how": "手停在物品上就拿起它，移到圆圈里停一会儿。",
};
