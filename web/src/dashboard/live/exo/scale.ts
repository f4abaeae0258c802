// Where values stand on the exoskeleton's bars: angles within limits, torques about a middle of zero. Shares are 0 to 100.
import type { JointLimits } from "../../../api/types";

/** Two ends of a joint's range, whoever set them. */
export type Ends = Pick<JointLimits, "min_rad" | "max_rad">;

export interface Span {
  low: number;
  high: number;
}

/** What an angle bar draws, from the outside in. */
export interface AngleScale {
  /** The bar itself: what the device can do. */
  device: Span;
  /** The patient's part of it. */
  patient: Span;
  /** Where set-points stay: the patient's part less the soft margin. */
  free: Span;
}

/** A narrow range keeps half of itself free of the soft margin, as in the station. */
const LARGEST_MARGIN = 0.25;

export function angleScale(patient: Ends, device: Ends | undefined, softMarginRad: number): AngleScale {
  const own = spanOf(patient);
  const outer = device ? spanOf(device) : own;
  const margin = Math.min(softMarginRad, (own.high - own.low) * LARGEST_MARGIN);
  return {
    device: { low: Math.min(own.low, outer.low), high: Math.max(own.high, outer.high) },
    patient: own,
    free: { low: own.low + margin, high: own.high - margin },
  };
}

/** Where in a span a value is; what lies outside stands at its end. */
export function shareOf(value: number, { low, high }: Span): number {
  return high > low ? Math.min(100, Math.max(0, (100 * (value - low)) / (high - low))) : 0;
}

/** A part of a span, as CSS wants it. */
export function partOf(part: Span, whole: Span): { left: string; width: string } {
  const [from, to] = [shareOf(part.low, whole), shareOf(part.high, whole)];
  return { left: `${from}%`, width: `${to - from}%` };
}

/** A bar that begins in the middle and grows towards the value's sign; full at `limit`. */
export function fromMiddle(value: number, limit: number): { left: string; width: string } {
  const whole = { low: -limit, high: limit };
  return partOf({ low: Math.min(0, value), high: Math.max(0, value) }, whole);
}

function spanOf({ min_rad, max_rad }: Ends): Span {
  return { low: min_rad, high: max_rad };
}
