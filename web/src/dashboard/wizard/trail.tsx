// Where the healthy hand has been, as spots that stay: its reach grows before one's eyes.
import { useRef } from "preact/hooks";
import type { LiveTick } from "../../api/types";

/** Spots as wide as a hand; a second visit leaves no second one. */
const SPOT_M = 0.06;

export function Trail({ tick }: { tick: LiveTick }) {
  const spots = useRef(new Set<string>());
  const hand = tick.healthy?.points_in_trunk[3];
  if (hand) spots.current.add(`${spotOf(hand[0])} ${spotOf(-hand[1])}`);
  return <path class="wizard-trail" d={[...spots.current].map((spot) => `M${spot}h0`).join("")} />;
}

function spotOf(metres: number): string {
  return (Math.round(metres / SPOT_M) * SPOT_M).toFixed(2);
}
