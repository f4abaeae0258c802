// 擦拭。
import type { gameWipe as english } from "../en/game-wipe";

export const gameWipe: Record<keyof typeof english, string> = {
  "game.wipe": "擦窗看景",
  "game.wipe.aim": "活动范围与耐力：在够得到的地方大幅擦拭",
  "game.wipe.how": "用手擦去标出的雾气，看看窗外是什么风景。",
};
