// The exoskeleton: measured against commanded within its limits, and what was clamped.
import { JOINTS, type Joint, type LiveTick } from "../../api/types";
import { t } from "../../strings";
import { angleText, sentence } from "../format";
import { type Feed, useFromFeed } from "./feed";

export function Exo({ feed }: { feed: Feed }) {
  const tick = useFromFeed(feed, 5, ({ newest }) => newest?.tick ?? null);
  if (!tick) return <section class="card" />;
  const notes = [tick.exo.fault, ...tick.exo.clamped].filter(Boolean).map(sentence).join(" · ");
  return (
    <section class="card exo" data-testid="exo">
      <table>
        <thead>
          <tr>
            <th>{t("exo.joint")}</th>
            <th class="number exo-mark-measured">{t("exo.measured")}</th>
            <th class="number exo-mark-commanded">{t("exo.commanded")}</th>
            <th class="exo-range">{t("exo.limits")}</th>
          </tr>
        </thead>
        <tbody>
          {JOINTS.map((joint, index) => (
            <Row key={joint} joint={joint} index={index} tick={tick} />
          ))}
        </tbody>
      </table>
      <p class="small caveat exo-note" title={notes}>
        {notes && `⚠ ${notes}`}
      </p>
    </section>
  );
}

function Row({ joint, index, tick }: { joint: Joint; index: number; tick: LiveTick }) {
  const limits = tick.limits.find((one) => one.joint === joint);
  const measured = tick.exo.angle_rad[index];
  const commanded = tick.exo.command_rad[index];
  return (
    <tr data-testid="exo-row">
      <td>{t(`joint.${joint}.short`)}</td>
      <td class="number">{angleText(measured)}</td>
      <td class="number">{angleText(commanded)}</td>
      <td class="exo-range">
        {limits && <Bar min={limits.min_rad} max={limits.max_rad} measured={measured} commanded={commanded} />}
      </td>
    </tr>
  );
}

interface BarProps {
  min: number;
  max: number;
  measured: number | undefined;
  commanded: number | undefined;
}

/** The range from end to end; full mark = measured, frame = commanded. */
function Bar({ min, max, measured, commanded }: BarProps) {
  const place = (angle: number | undefined) => ({ left: `${shareOf(angle ?? min, min, max)}%` });
  return (
    <div>
      <span class="exo-end number">{angleText(min)}</span>
      <div class="exo-bar">
        <div class="exo-measured" style={place(measured)} />
        <div class="exo-commanded" style={place(commanded)} />
      </div>
      <span class="exo-end">{angleText(max)}</span>
    </div>
  );
}

/** Where in its range an angle is, 0 to 100. */
function shareOf(angle: number, min: number, max: number): number {
  return Math.min(100, Math.max(0, (100 * (angle - min)) / (max - min)));
}
