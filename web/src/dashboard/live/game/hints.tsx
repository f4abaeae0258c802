// What the game has noticed of the patient: leaning, hitching, tiring.
import type { GameView } from "../../../api/types";
import { t } from "../../../strings";

export function Hints({ game: { posture, rest_suggested } }: { game: GameView }) {
  const hints = [
    ...(posture === "lean" || posture === "hitch" ? [t(`game.posture.${posture}`)] : []),
    ...(rest_suggested ? [t("game.tired")] : []),
  ];
  return (
    <p class="game-hints small" aria-live="polite" data-testid="game-hints">
      {hints.length > 0 ? <strong>⚠ {hints.join(" · ")}</strong> : <span class="soft">{t("game.posture.good")}</span>}
    </p>
  );
}
