// What reports are made of: facts, games, figures, ranges, scores.
import type { ComponentChildren } from "preact";
import { JOINTS, type ProgressLine, type Score, type SessionDetail, type Side } from "../../api/types";
import { t } from "../../strings";
import { gameName } from "../../strings/games";
import { angleText, dateText, figure } from "../format";
import { RangePicture } from "../patient/range-picture";
import { RangeKey, sectorsOf } from "../progress/arm-ranges";
import { type Ranges, rangesOf, widthOf } from "../progress/ranges";
import { GREATEST } from "../scores/scales";

const SECONDS = 60;

export function Facts({ facts }: { facts: readonly (readonly [string, string])[] }) {
  return (
    <dl class="sheet-facts">
      {facts.map(([name, value]) => (
        <div key={name}>
          <dt>{name}</dt>
          <dd>{value}</dd>
        </div>
      ))}
    </dl>
  );
}

export function Part({ title, children }: { title: string; children: ComponentChildren }) {
  return (
    <section class="sheet-part">
      <h2>{title}</h2>
      {children}
    </section>
  );
}

export type Played = SessionDetail["played"][number];

/** What was played, a row a game; of several sessions the rows of one game are added up. */
export function GamesTable({ played }: { played: readonly Played[] }) {
  if (played.length === 0) return <p>{t("report.games.none")}</p>;
  return (
    <table>
      <thead>
        <tr>
          <th>{t("report.game")}</th>
          <th class="number">{t("report.minutes")}</th>
          <th class="number">{t("report.attempts")}</th>
          <th class="number">{t("report.succeeded")}</th>
          <th class="number">{t("report.level")}</th>
        </tr>
      </thead>
      <tbody>
        {addedUp(played).map(({ game, played_s, hits, misses, level }) => (
          <tr key={game}>
            <th scope="row">{gameName(game)}</th>
            <td class="number">{figure(played_s / SECONDS, 1)}</td>
            <td class="number">{hits + misses}</td>
            <td class="number">{hits + misses > 0 ? `${figure((100 * hits) / (hits + misses))} %` : "–"}</td>
            <td class="number">{figure(100 * level)} %</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

/** By game; the level is the last one reached. */
export function addedUp(played: readonly Played[]): Played[] {
  const games = new Map<string, Played>();
  for (const one of played) {
    const before = games.get(one.game);
    games.set(
      one.game,
      before
        ? {
            ...one,
            played_s: before.played_s + one.played_s,
            score: before.score + one.score,
            hits: before.hits + one.hits,
            misses: before.misses + one.misses,
          }
        : one,
    );
  }
  return [...games.values()];
}

/** Both arms of each joint, in the first, the last and the widest session. */
export function RangePictures({ lines, affected }: { lines: readonly ProgressLine[]; affected: Side }) {
  const known = JOINTS.filter((joint) => rangesOf(lines, joint, "left") ?? rangesOf(lines, joint, "right"));
  if (known.length === 0) return <p>{t("progress.range.unknown")}</p>;
  const arm = (joint: (typeof JOINTS)[number], side: Side) => rangesOf(lines, joint, side);
  const isDriven = known.some((joint) => arm(joint, affected)?.isDriven);
  return (
    <>
      <div class="sheet-ranges">
        {known.map((joint) => (
          <figure key={joint}>
            <figcaption>{t(`joint.${joint}`)}</figcaption>
            <div class="sheet-arms">
              {(["left", "right"] as const).map((side) => (
                <div key={side}>
                  <RangePicture joint={joint} side={side} sectors={sectorsIn(arm(joint, side))} />
                  <span>
                    {t(`side.${side}`)}
                    {side === affected && ` (${t("arm.affected.short")})`}
                  </span>
                  <strong>{widthText(arm(joint, side))}</strong>
                </div>
              ))}
            </div>
          </figure>
        ))}
      </div>
      <RangeKey />
      {isDriven && <p>⚠ {t("report.range.driven")}</p>}
    </>
  );
}

function sectorsIn(ranges: Ranges | null) {
  return ranges ? sectorsOf(ranges) : [];
}

/** `56° → 74°`, or one number where there is one session only. */
function widthText(ranges: Ranges | null): string {
  if (!ranges) return t("progress.range.unknown");
  const [first, last] = [angleText(widthOf(ranges.first)), angleText(widthOf(ranges.last))];
  return ranges.first.session === ranges.last.session ? last : `${first} → ${last}`;
}

export function ScoresTable({ scores }: { scores: readonly Score[] }) {
  if (scores.length === 0) return <p>{t("scores.none")}</p>;
  return (
    <table>
      <thead>
        <tr>
          <th>{t("scores.kind")}</th>
          <th>{t("scores.side")}</th>
          <th>{t("report.values")}</th>
        </tr>
      </thead>
      <tbody>
        {byTest(scores).map((same) => (
          <ScoreRow key={`${same[0]?.kind}${same[0]?.side}`} scores={same} />
        ))}
      </tbody>
    </table>
  );
}

const MOST_VALUES = 4;

/** The first and the newest ones, oldest first. */
function ScoreRow({ scores }: { scores: readonly Score[] }) {
  const [first] = scores;
  if (!first) return null;
  const shown = scores.length <= MOST_VALUES ? scores : [first, ...scores.slice(1 - MOST_VALUES)];
  return (
    <tr>
      <th scope="row">
        {t(`score.${first.kind}`)} (0–{GREATEST[first.kind]})
      </th>
      <td>{t(`side.${first.side}`)}</td>
      <td>{shown.map(({ value, on, rater }) => `${value} (${dateText(on)}, ${rater})`).join(" → ")}</td>
    </tr>
  );
}

/** Scores of one test and arm together, in the order of their days. */
function byTest(scores: readonly Score[]): Score[][] {
  const tests = new Map<string, Score[]>();
  for (const score of scores) {
    const id = `${score.kind}/${score.side}`;
    tests.set(id, [...(tests.get(id) ?? []), score]);
  }
  return [...tests.values()];
}
