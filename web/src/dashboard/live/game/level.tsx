// How hard the game is: it follows success, unless the therapist pins it.
import type { GameView } from "../../../api/types";
import { t } from "../../../strings";
import { figure } from "../../format";
import type { WishOf } from "./panel";
import { maySetLevel } from "./wishes";

const STEP = 0.05;

interface Props {
  game: GameView;
  isMine: boolean;
  wish: WishOf;
}

export function Level({ game, isMine, wish }: Props) {
  const { level, pinned } = game;
  const isFixed = !isMine || !maySetLevel(game);
  const pinAt = (wanted: number) => wish("pin", Math.min(1, Math.max(0, wanted)));
  return (
    <fieldset class="game-level" aria-label={t("game.level")} data-testid="level" data-pinned={pinned}>
      <span class="small">{t("game.level")}</span>
      <button
        type="button"
        aria-label={t("game.easier")}
        disabled={isFixed || level <= 0}
        onClick={() => pinAt(level - STEP)}
        data-testid="easier"
      >
        −
      </button>
      <output data-testid="level-value">{figure(100 * level)} %</output>
      <button
        type="button"
        aria-label={t("game.harder")}
        disabled={isFixed || level >= 1}
        onClick={() => pinAt(level + STEP)}
        data-testid="harder"
      >
        +
      </button>
      <button
        type="button"
        class="game-pin"
        aria-pressed={pinned}
        disabled={isFixed}
        title={t(pinned ? "game.pinned.means" : "game.adapts.means")}
        onClick={() => wish(pinned ? "adapt" : "pin")}
        data-testid="pin"
      >
        {t(pinned ? "game.pinned" : "game.adapts")}
      </button>
    </fieldset>
  );
}
