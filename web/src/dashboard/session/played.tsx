// What was played: each game with its score, how often it succeeded, and how hard it was at its end.
import type { SessionDetail } from "../../api/types";
import { t } from "../../strings";
import { gameName } from "../../strings/games";
import { duration, figure } from "../format";
import { successOf } from "../live/game/wishes";
import { Scroll } from "../scroll";

type Played = SessionDetail["played"][number];

export function PlayedGames({ played }: { played: readonly Played[] }) {
  return (
    <section class="card" data-testid="played">
      <h2>{t("played.title")}</h2>
      {played.length === 0 ? <p class="soft">{t("played.none")}</p> : <Table played={played} />}
    </section>
  );
}

function Table({ played }: { played: readonly Played[] }) {
  return (
    <Scroll label={t("played.title")}>
      <table>
        <thead>
          <tr>
            <th>{t("summary.game")}</th>
            <th class="number">{t("played.time")}</th>
            <th class="number">{t("played.score")}</th>
            <th class="number">{t("played.success")}</th>
            <th class="number">{t("played.level")}</th>
          </tr>
        </thead>
        <tbody>
          {played.map((one, index) => (
            <tr key={`${index} ${one.game}`} data-testid="played-game">
              <th scope="row">{gameName(one.game)}</th>
              <td class="number">{duration(one.played_s)}</td>
              <td class="number">{one.score}</td>
              <td class="number">{successText(one)}</td>
              <td class="number">{figure(100 * one.level)} %</td>
            </tr>
          ))}
        </tbody>
      </table>
    </Scroll>
  );
}

function successText(one: Played): string {
  const share = successOf(one);
  const attempts = one.hits + one.misses;
  return share === null ? "–" : t("played.share", { share: figure(100 * share), hits: one.hits, attempts });
}
