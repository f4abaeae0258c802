// 伸手与采摘。
import type { gameReach as english } from "../en/game-reach";

export const gameReach: Record<keyof typeof english, string> = {
  "game.reach": "摘水果",
  "game.reach.aim": "活动范围：一点一点够得更远",
  "game.reach.how": "把手移到水果处，停在那里，直到圆环填满。",
};
