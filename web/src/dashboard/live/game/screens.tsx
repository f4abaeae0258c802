// Whether the patient sees the game, and the way to open their screen.
import { t } from "../../../strings";
import type { Charge } from "../charge";
import { type Feed, useFromFeed } from "../feed";
import { PlayLink } from "../play-link";
import type { WishOf } from "./panel";

interface Props {
  feed: Feed;
  charge: Charge;
  wish: WishOf;
}

export function Screens({ feed, charge, wish }: Props) {
  const count = useFromFeed(feed, 2, ({ newest }) => newest?.session?.patient_screens ?? 0);
  const isLost = useFromFeed(feed, 2, ({ newest }) => newest?.session?.screen_lost ?? false);
  return (
    <div class={isLost ? "game-screens game-screens-lost" : "game-screens"} data-testid="screens" data-count={count}>
      <span class="small">{wordsOf(count, isLost)}</span>
      {isLost && (
        <button
          type="button"
          disabled={charge !== "mine"}
          onClick={() => wish("go_on")}
          data-testid="go-on-without-screen"
        >
          {t("game.screen.without")}
        </button>
      )}
      <PlayLink />
    </div>
  );
}

function wordsOf(count: number, isLost: boolean): string {
  if (isLost) return `⚠ ${t("game.screen.lost")}`;
  if (count === 0) return t("game.screen.none");
  return count === 1 ? `✓ ${t("game.screen.one")}` : `✓ ${t("game.screen.several", { count })}`;
}
