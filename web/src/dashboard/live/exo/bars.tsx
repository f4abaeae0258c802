// The pictures in a joint's row; every value that they show stands beside them as a number.
import type { JointLimits } from "../../../api/types";
import { angleText, figure } from "../../format";
import { angleScale, type Ends, fromMiddle, partOf, shareOf } from "./scale";

interface AngleProps {
  limits: JointLimits;
  device: Ends | undefined;
  softMarginRad: number;
  measured: number | undefined;
  commanded: number | undefined;
}

/** Needle = measured, frame = commanded; hatched = the device could, the patient may not; pale ends = soft margin. */
export function AngleBar({ limits, device, softMarginRad, measured, commanded }: AngleProps) {
  const scale = angleScale(limits, device, softMarginRad);
  const place = (angle: number | undefined) => ({ left: `${shareOf(angle ?? scale.device.low, scale.device)}%` });
  return (
    <div class="exo-angle">
      <span class="exo-end number">{angleText(limits.min_rad)}</span>
      <div class="exo-bar exo-bar-angle" aria-hidden="true">
        <div class="exo-patient" style={partOf(scale.patient, scale.device)} />
        <div class="exo-free" style={partOf(scale.free, scale.device)} />
        {commanded !== undefined && <div class="exo-commanded" style={place(commanded)} />}
        {measured !== undefined && <div class="exo-measured" style={place(measured)} />}
      </div>
      <span class="exo-end">{angleText(limits.max_rad)}</span>
    </div>
  );
}

interface EffortProps {
  value: number | undefined;
  limit: number | undefined;
}

/** The arm's own torque about zero; the bar is full where it resists too much, and says so by a sign as well. */
export function EffortBar({ value, limit }: EffortProps) {
  const known = value !== undefined && limit !== undefined && limit > 0;
  const isFull = known && Math.abs(value) >= limit;
  return (
    <div class="exo-effort">
      <div class="exo-bar" aria-hidden="true">
        {known && <div class={isFull ? "exo-fill exo-full" : "exo-fill"} style={fromMiddle(value, limit)} />}
        <div class="exo-zero" />
      </div>
      <span class="number">
        {isFull && "⚠"}
        {figure(value, 1)}
        <span class="exo-end"> /{figure(limit)}</span>
      </span>
    </div>
  );
}
