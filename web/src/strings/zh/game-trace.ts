// 描线。
import type { gameTrace as english } from "../en/game-trace";

export const gameTrace: Record<keyof typeof english, string> = {
  "game.trace": "湖上引灯",
  "game.trace.aim": "流畅与准确：沿着弯弯的路，手要稳",
  "game.trace.how": "把手移到灯笼处，带着它沿着光路慢慢走到花前。",
};
