// Beside the therapy: the game's score, the patient's screen, the end of the session.
import { t } from "../../strings";
import { duration } from "../format";
import { type Feed, useFromFeed } from "./feed";

const PLAY_PAGE = "/play.html";

export function Aside({ feed, onEnd }: { feed: Feed; onEnd: () => void }) {
  const elapsed = useFromFeed(feed, 2, ({ newest }) => newest?.session?.elapsed_s ?? 0);
  return (
    <section class="card live-side">
      <div>
        <Score feed={feed} />
        <div class="small soft">{t("live.elapsed", { time: duration(elapsed) })}</div>
      </div>
      <a class="button" href={PLAY_PAGE} target="mirrorlimb-play" data-testid="open-play">
        {t("live.play")}
      </a>
      <button type="button" onClick={onEnd} data-testid="end-session">
        {t("session.end")}
      </button>
    </section>
  );
}

function Score({ feed }: { feed: Feed }) {
  const score = useFromFeed(feed, 5, ({ newest }) => newest?.game?.score ?? 0);
  const hits = useFromFeed(feed, 5, ({ newest }) => newest?.game?.hits ?? 0);
  return (
    <>
      <div class="small soft">{t("live.score", { hits })}</div>
      <div class="score" data-testid="score">
        {score}
      </div>
    </>
  );
}
