// Share of attempts that succeeded, against what the difficulty aims at.
import type { GameView } from "../../../api/types";
import { t } from "../../../strings";
import { figure } from "../../format";
import { successOf } from "./wishes";

/** As the staircase has it (games/difficulty.py). */
const WANTED = 0.75;

export function Success({ game }: { game: GameView }) {
  const share = successOf(game);
  const words = t("game.success", {
    share: share === null ? "–" : figure(100 * share),
    wanted: figure(100 * WANTED),
    attempts: game.hits + game.misses,
  });
  return (
    <div class="game-success" data-testid="success">
      <span class="small">{words}</span>
      <svg viewBox="0 0 100 8" preserveAspectRatio="none" aria-hidden="true">
        <rect class="game-bar" width="100" height="8" />
        <rect class="game-share" width={100 * (share ?? 0)} height="8" />
        <line class="game-wanted" x1={100 * WANTED} x2={100 * WANTED} y1="0" y2="8" />
      </svg>
    </div>
  );
}
