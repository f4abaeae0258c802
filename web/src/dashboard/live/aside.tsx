// Beside the therapy: the game's score, the patient's screen, the end of the session.
import type { Session } from "../../api/types";
import { t } from "../../strings";
import { duration } from "../format";
import { type Feed, useFromFeed } from "./feed";
import { PlayLink } from "./play-link";
import type { Question } from "./who";
import "./aside.css";

interface Props {
  feed: Feed;
  session: Session;
  who: Question;
  onEnd: () => void;
}

export function Aside({ feed, session, who, onEnd }: Props) {
  const elapsed = useFromFeed(feed, 2, ({ newest }) => newest?.session?.elapsed_s ?? 0);
  return (
    <section class="card live-side">
      <div>
        <div class="live-who">
          <strong>{session.patient_name}</strong>
          <span title={t("history.duration")}>{duration(elapsed)}</span>
        </div>
        <div class="small">{t(`patient.affected.${session.affected_side}`)}</div>
      </div>
      <Score feed={feed} />
      <button type="button" onClick={who.ask} aria-expanded={who.isShown} data-testid="ask-who">
        {who.isConfirmed ? `✓ ${t("who.confirmed")}` : t("who.title")}
      </button>
      <PlayLink />
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
    <div class="live-score">
      <span class="score" data-testid="score">
        {score}
      </span>
      <span class="small soft">{t("live.score", { hits })}</span>
    </div>
  );
}
