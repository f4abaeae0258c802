// The exoskeleton: measured against commanded within its limits, torques, help, and what was clamped and why.
import { readStation } from "../../../api/client";
import { JOINTS, type LiveTick } from "../../../api/types";
import { t } from "../../../strings";
import { sentence } from "../../format";
import { useAsked } from "../../hooks";
import type { Charge } from "../charge";
import { type Feed, useFromFeed } from "../feed";
import { byReason } from "./clamps";
import { Help } from "./help";
import { JointRow } from "./row";
import "./exo.css";

interface Props {
  feed: Feed;
  session: number;
  charge: Charge;
}

export function Exo({ feed, session, charge }: Props) {
  const tick = useFromFeed(feed, 5, ({ newest }) => newest?.tick ?? null);
  const station = useAsked(readStation, "station").value;
  if (!tick) return <section class="card exo" />;
  const clamped = feed.clampedLately();
  return (
    <section class="card exo" aria-label={t("exo.title")} data-testid="exo">
      <Help feed={feed} session={session} isMine={charge === "mine"} />
      <div class="table-scroll">
        <table>
          <Head />
          <tbody>
            {JOINTS.map((joint, index) => (
              <JointRow
                key={joint}
                {...{ joint, index, tick, clamped }}
                device={station?.device.find((one) => one.joint === joint)}
                softMarginRad={station?.soft_margin_rad ?? 0}
              />
            ))}
          </tbody>
        </table>
      </div>
      <Notes words={notesOf(tick, clamped)} />
    </section>
  );
}

function Head() {
  return (
    <thead>
      <tr>
        <th>{t("exo.joint")}</th>
        <th class="number exo-mark-measured">{t("exo.measured")}</th>
        <th class="number exo-mark-commanded">{t("exo.commanded")}</th>
        <th class="exo-wide" title={t("exo.limits.means")}>
          {t("exo.limits")}
        </th>
        <th class="number" title={t("exo.torque.means")}>
          {t("exo.torque")}
        </th>
        <th title={t("exo.effort.means")}>{t("exo.effort")}</th>
        <th class="number" title={t("exo.share.means")}>
          {t("exo.share")}
        </th>
      </tr>
    </thead>
  );
}

/** What the limits changed and why; else how to read the table, at the same place, so that nothing jumps. */
function Notes({ words }: { words: readonly string[] }) {
  if (words.length > 0) {
    const said = words.join(" · ");
    return (
      <p class="small exo-note" title={said} data-testid="exo-notes">
        ⚠ {said}
      </p>
    );
  }
  return (
    <p class="exo-note exo-legend" data-testid="exo-notes">
      {t("exo.unclamped")} {t("exo.legend")}
    </p>
  );
}

function notesOf({ exo }: LiveTick, clamped: readonly string[]): string[] {
  return [...(exo.fault ? [sentence(exo.fault)] : []), ...byReason(clamped)];
}
