// The range of both arms as pictures: each joint left and right, in the first, the last and the widest session.
import { JOINTS, type Joint, type ProgressLine, type Side } from "../../api/types";
import { t } from "../../strings";
import { angleText, degrees, figure } from "../format";
import { RangePicture, type Sector } from "../patient/range-picture";
import { type Range, type Ranges, rangesOf, widthOf } from "./ranges";

interface Props {
  lines: readonly ProgressLine[];
  affected: Side;
}

export function ArmRanges({ lines, affected }: Props) {
  const known = JOINTS.filter((joint) => rangesOf(lines, joint, "left") ?? rangesOf(lines, joint, "right"));
  if (known.length === 0) return null;
  return (
    <section class="card" data-testid="arm-ranges">
      <h2>{t("progress.ranges")}</h2>
      <RangeKey />
      <div class="arm-ranges">
        {known.map((joint) => (
          <JointRanges key={joint} joint={joint} lines={lines} affected={affected} />
        ))}
      </div>
    </section>
  );
}

export function RangeKey() {
  return (
    <ul class="range-key small">
      {(["first", "last", "best"] as const).map((which) => (
        <li key={which}>
          <svg viewBox="0 0 26 18" width="26" height="18" aria-hidden="true">
            <rect class={`sector-${which}`} x="2" y="2" width="22" height="14" />
          </svg>
          {t(`progress.range.${which}`)}
        </li>
      ))}
    </ul>
  );
}

export function JointRanges({ joint, lines, affected }: Props & { joint: Joint }) {
  const [left, right] = [rangesOf(lines, joint, "left"), rangesOf(lines, joint, "right")];
  return (
    <section class="joint-ranges" aria-label={t(`joint.${joint}`)} data-testid="joint-ranges" data-joint={joint}>
      <h3>{t(`joint.${joint}`)}</h3>
      <div class="joint-pair">
        <ArmRange joint={joint} side="left" ranges={left} affected={affected} />
        <ArmRange joint={joint} side="right" ranges={right} affected={affected} />
      </div>
      <Compared ranges={affected === "left" ? [left, right] : [right, left]} />
    </section>
  );
}

interface ArmProps {
  joint: Joint;
  side: Side;
  ranges: Ranges | null;
  affected: Side;
}

function ArmRange({ joint, side, ranges, affected }: ArmProps) {
  const arm = t(side === affected ? "arm.affected.short" : "arm.healthy.short");
  return (
    <div class="arm-range">
      <RangePicture joint={joint} side={side} sectors={ranges ? sectorsOf(ranges) : []} />
      <strong class="small">
        {t(`side.${side}`)} · {arm}
      </strong>
      {ranges ? <Numbers ranges={ranges} /> : <span class="small soft">{t("progress.range.unknown")}</span>}
    </div>
  );
}

function Numbers({ ranges }: { ranges: Ranges }) {
  return (
    <>
      <dl class="range-numbers small">
        {(["first", "last", "best"] as const).map((which) => (
          <div key={which}>
            <dt>{t(`progress.range.${which}`)}</dt>
            <dd>{rangeText(ranges[which])}</dd>
          </div>
        ))}
      </dl>
      {ranges.isDriven && <span class="small caveat">⚠ {t("progress.range.driven")}</span>}
      {ranges.isOwn && <span class="small soft">{t("progress.range.own")}</span>}
    </>
  );
}

/** How far the affected arm goes, of what the healthy one does; nothing where the drive moved it. */
function Compared({ ranges: [affected, healthy] }: { ranges: readonly (Ranges | null)[] }) {
  if (!affected || !healthy || affected.isDriven || widthOf(healthy.last) <= 0) return null;
  const share = (100 * widthOf(affected.last)) / widthOf(healthy.last);
  return <p class="small">{t("progress.range.compared", { share: figure(share) })}</p>;
}

export function rangeText(range: Range): string {
  return t("progress.range.text", {
    width: angleText(widthOf(range)),
    low: angleText(range.lowest),
    high: angleText(range.highest),
  });
}

export function sectorsOf({ first, last, best }: Ranges): Sector[] {
  const sector = ({ lowest, highest }: Range, look: Sector["look"]): Sector => ({
    minDeg: degrees(lowest),
    maxDeg: degrees(highest),
    look,
  });
  return [sector(best, "best"), sector(last, "last"), sector(first, "first")];
}
