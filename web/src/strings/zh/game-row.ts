// 划船。
import type { gameRow as english } from "../en/game-row";

export const gameRow: Record<keyof typeof english, string> = {
  "game.row": "划船",
  "game.row.aim": "双臂配合：左右划得一样",
  "game.row.how": "双手一起向前伸进圆环，再一起拉回来。",
};
