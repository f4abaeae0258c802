// A sign for each state of the arm: told apart by shape, not by colour.
import type { DriveState } from "../../api/types";

/** The arm's state, or that of session or connection where the arm's does not matter. */
export type BannerState = DriveState | "interrupted" | "connecting" | "lost";

const TRIANGLE = "M20 2 L39 37 H1 Z M18 14 L19 26 H21 L22 14 Z M20 28 a2.5 2.5 0 1 1 -0.01 0";

const SHAPES: Record<BannerState, string> = {
  off: "M20 6 a14 14 0 1 0 0.01 0 M20 12 a8 8 0 1 1 -0.01 0",
  ready: "M20 3 L37 20 L20 37 L3 20 Z",
  engaged: "M8 4 L36 20 L8 36 Z",
  hold: "M7 5 H16 V35 H7 Z M24 5 H33 V35 H24 Z",
  fault: TRIANGLE,
  interrupted: TRIANGLE,
  stopped: "M5 5 H35 V35 H5 Z",
  connecting: "M6 17 h6 v6 h-6 Z M17 17 h6 v6 h-6 Z M28 17 h6 v6 h-6 Z",
  lost: "M23 2 L8 22 H18 L14 38 L32 15 H21 Z",
};

export function StateSign({ state }: { state: BannerState }) {
  return (
    <svg class="state-sign" viewBox="0 0 40 40" aria-hidden="true">
      <path d={SHAPES[state]} fill="currentColor" fill-rule="evenodd" />
    </svg>
  );
}
