// Beside the therapy: whose session it is, the sensors, the end of the session.
import type { Session } from "../../api/types";
import { t } from "../../strings";
import { duration } from "../format";
import { type Feed, useFromFeed } from "./feed";
import { SensorLines } from "./sensor-lines";
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
      <SensorLines feed={feed} />
      <button type="button" onClick={who.ask} aria-expanded={who.isShown} data-testid="ask-who">
        {who.isConfirmed ? `✓ ${t("who.confirmed")}` : t("who.title")}
      </button>
      <button type="button" onClick={onEnd} data-testid="end-session">
        {t("session.end")}
      </button>
    </section>
  );
}
