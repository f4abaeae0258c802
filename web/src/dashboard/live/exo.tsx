// The exoskeleton: measured against commanded within its limits, and what was clamped.
import { JOINTS, type Joint, type LiveTick } from "../../api/types";
import { t } from "../../strings";
import { angleText, sentence } from "../format";
import { type Feed, useFromFeed } from "./feed";

export function Exo({ feed }: { feed: Feed }) {
  const tick = useFromFeed(feed, 5, ({ newest }) => newest?.tick ?? null);
  if (!tick) return <section class="card" />;
  const notes = [tick.exo.fault, ...tick.exo.clamped].filter(Boolean);
  return (
    <section class="card" data-testid="exo">
      <table>
        <thead>
          <tr>
            <th>{t("exo.joint")}</th>
            <th class="number">{t("exo.measured")}</th>
            <th class="number">{t("exo.commanded")}</th>
            <th class="number">{t("exo.limits")}</th>
            <th>
              <span class="exo-key">
                ▮ {t("exo.measured")} ▯ {t("exo.commanded")}
              </span>
            </th>
          </tr>
        </thead>
        <tbody>
          {JOINTS.map((joint, index) => (
            <Row key={joint} joint={joint} index={index} tick={tick} />
          ))}
        </tbody>
      </table>
      <p class="small caveat">{notes.length > 0 ? `⚠ ${notes.map(sentence).join(" · ")}` : ""}</p>
    </section>
  );
}

function Row({ joint, index, tick }: { joint: Joint; index: number; tick: LiveTick }) {
  const limits = tick.limits.find((one) => one.joint === joint);
  const measured = tick.exo.angle_rad[index];
  const commanded = tick.exo.command_rad[index];
  const place = (angle: number | undefined) =>
    limits && angle !== undefined
      ? { left: `${shareOf(angle, limits.min_rad, limits.max_rad)}%` }
      : { display: "none" };
  return (
    <tr data-testid="exo-row">
      <td>{t(`joint.${joint}.short`)}</td>
      <td class="number">{angleText(measured)}</td>
      <td class="number">{angleText(commanded)}</td>
      <td class="number">{limits ? `${angleText(limits.min_rad)} … ${angleText(limits.max_rad)}` : "–"}</td>
      <td>
        <div class="exo-bar">
          <div class="exo-measured" style={place(measured)} />
          <div class="exo-commanded" style={place(commanded)} />
        </div>
      </td>
    </tr>
  );
}

/** Where in its range an angle is, 0 to 100. */
function shareOf(angle: number, min: number, max: number): number {
  return Math.min(100, Math.max(0, (100 * (angle - min)) / (max - min)));
}
