// The game for the therapist: where it stands, how hard it is, and what can be wished of it.
import { wishOfGame } from "../../../api/client";
import type { GameView, GameWish } from "../../../api/types";
import { t } from "../../../strings";
import { gameName } from "../../../strings/games";
import { duration } from "../../format";
import { useDoing } from "../../hooks";
import { ProblemBox } from "../../problem";
import type { Charge } from "../charge";
import { type Feed, useFromFeed } from "../feed";
import { Hints } from "./hints";
import { Level } from "./level";
import { Screens } from "./screens";
import { Success } from "./success";
import { mainWish, mayGoToNext, mayRest, mayWishOfGame } from "./wishes";
import "./game.css";

interface Props {
  feed: Feed;
  session: number;
  charge: Charge;
}

export type WishOf = (wish: GameWish, level?: number) => void;

export function GamePanel({ feed, session, charge }: Props) {
  const game = useFromFeed(feed, 5, ({ newest }) => newest?.game ?? null);
  const doing = useDoing();
  const wish: WishOf = (wanted, level) =>
    doing.run(async () => {
      await wishOfGame(session, wanted, level);
    });
  return (
    <section class="card game" aria-label={t("game.panel")} data-testid="game" data-phase={game?.phase ?? ""}>
      {game ? <Playing game={game} charge={charge} wish={wish} /> : <Waiting feed={feed} />}
      <Screens feed={feed} charge={charge} wish={wish} />
      <ProblemBox problem={doing.problem} onClose={doing.forget} />
    </section>
  );
}

/** Before the arm has moved: what will be played. */
function Waiting({ feed }: { feed: Feed }) {
  const exercises = useFromFeed(feed, 1, ({ newest }) => newest?.session?.exercises ?? []);
  return (
    <>
      <p>{t("game.waits")}</p>
      <ol class="game-programme">
        {exercises.map(({ game, minutes }, index) => (
          <li key={`${index} ${game}`}>
            {gameName(game)}, {t("programme.minutes", { minutes })}
          </li>
        ))}
      </ol>
    </>
  );
}

function Playing({ game, charge, wish }: { game: GameView; charge: Charge; wish: WishOf }) {
  return (
    <>
      <div class="game-head">
        <strong>{gameName(game.game)}</strong>
        <span>{t("game.place", { exercise: game.exercise, exercises: game.exercises })}</span>
        <span class="game-time">{phaseOf(game)}</span>
      </div>
      <div class="game-now">
        <span class="score" data-testid="score">
          {game.score}
        </span>
        <span class="small soft">{t("game.points")}</span>
        <Success game={game} />
      </div>
      <Level game={game} isMine={charge === "mine"} wish={wish} />
      <Buttons game={game} charge={charge} wish={wish} />
      <Hints game={game} />
    </>
  );
}

function phaseOf({ phase, round, rounds, time_left_s }: GameView): string {
  return t(`game.phase.${phase}`, { round, rounds, time: duration(time_left_s) });
}

function Buttons({ game, charge, wish }: { game: GameView; charge: Charge; wish: WishOf }) {
  const main = mainWish(game);
  return (
    <div class="game-buttons">
      <Button name={main ?? "pause"} isPossible={main !== null} {...{ charge, wish }} />
      <Button name="rest" isPossible={mayRest(game)} {...{ charge, wish }} />
      <Button name="next" isPossible={mayGoToNext(game)} {...{ charge, wish }} />
    </div>
  );
}

interface ButtonProps {
  name: "start" | "pause" | "go_on" | "rest" | "next";
  isPossible: boolean;
  charge: Charge;
  wish: WishOf;
}

function Button({ name, isPossible, charge, wish }: ButtonProps) {
  return (
    <button
      type="button"
      disabled={!isPossible || !mayWishOfGame(name, charge)}
      onClick={() => wish(name)}
      data-testid={`game-${name}`}
    >
      {t(`game.wish.${name}`)}
    </button>
  );
}
