// Opens the patient's screen.
import { t } from "../../strings";

const PLAY_PAGE = "/play.html";

/** Without an opener: with one it would share the dashboard's thread, and its drawing would hold up our answers. */
export function PlayLink() {
  return (
    <a class="button" href={PLAY_PAGE} target="_blank" rel="noopener" data-testid="open-play">
      {t("live.play")}
    </a>
  );
}
