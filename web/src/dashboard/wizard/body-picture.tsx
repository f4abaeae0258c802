// The patient as the sensors see them, from behind, drawn anew a few times a second.
import type { LiveTick, Side } from "../../api/types";
import { t } from "../../strings";
import { type Feed, useFromFeed } from "../live/feed";
import { armLines, type Frame, frameOf, type Joint3, type Line, trunkLines } from "./body-lines";
import { Trail } from "./trail";

const PICTURES_PER_S = 8;
/** Metres about the top of the breastbone: room for both arms stretched out. */
const VIEW = "-0.95 -0.62 1.9 1.3";

interface Props {
  feed: Feed;
  affected: Side;
  /** Each sensor's own picture of the body too. */
  withSensors: boolean;
  /** Where the healthy hand has been. */
  withTrail: boolean;
}

export function BodyPicture({ feed, affected, withSensors, withTrail }: Props) {
  const tick = useFromFeed(feed, PICTURES_PER_S, ({ newest }) => newest?.tick ?? null);
  const joints = (tick?.body?.joints_in_room ?? []) as readonly Joint3[];
  const frame = frameOf(joints);
  if (!tick || !frame) return <p class="wizard-blank soft">{t("wizard.picture.nobody")}</p>;
  const healthy = affected === "left" ? "right" : "left";
  return (
    <svg class="wizard-body" viewBox={VIEW} role="img" aria-label={t("wizard.picture.body")}>
      {withTrail && <Trail tick={tick} />}
      <Lines lines={trunkLines(joints, frame)} name="wizard-trunk" />
      <circle class="wizard-head" {...headOf(joints, frame)} r="0.11" />
      <Lines lines={armLines(joints, healthy, frame)} name="wizard-healthy" />
      <Lines lines={armLines(joints, affected, frame)} name="wizard-affected" />
      {withSensors && <SensorBodies tick={tick} frame={frame} />}
    </svg>
  );
}

function SensorBodies({ tick, frame }: { tick: LiveTick; frame: Frame }) {
  return (
    <>
      {tick.sensors.map(({ sensor, joints_in_room }) => {
        const joints = joints_in_room as readonly Joint3[];
        const lines = [trunkLines, ...SIDES].flatMap((linesOf) => linesOf(joints, frame));
        return <Lines key={sensor} lines={lines} name="wizard-seen" />;
      })}
    </>
  );
}

const SIDES = (["left", "right"] as const).map(
  (side) => (joints: readonly Joint3[], frame: Frame) => armLines(joints, side, frame),
);

function Lines({ lines, name }: { lines: readonly Line[]; name: string }) {
  const path = lines.map(([x1, y1, x2, y2]) => `M${mm(x1)} ${mm(y1)}L${mm(x2)} ${mm(y2)}`).join("");
  return <path class={name} d={path} />;
}

function mm(metres: number): string {
  return metres.toFixed(3);
}

/** The head is drawn about the end of the spine's line. */
function headOf(joints: readonly Joint3[], frame: Frame): { cx: number; cy: number } {
  const neck = trunkLines(joints, frame).at(3);
  return { cx: neck?.[2] ?? 0, cy: neck?.[3] ?? -0.3 };
}
