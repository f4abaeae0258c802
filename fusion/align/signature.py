"""A person's bone lengths as one sensor shows them: enough to tell people of different build apart, not of the same.

A depth camera's lengths change with the view by 4–7 % (standard deviation over a walk, `SPREAD`), and each sensor has
its own errors; so a signature is learnt per sensor, follows slowly, and only a misfit in several bones says something.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import log, sqrt
from typing import Final

import numpy as np

from fusion.align.loops import apart
from fusion.compiled import kernel
from fusion.messages import Floats, States
from fusion.skeleton import INDEX, TrackingState

_PAIRS: Final = (
    ("SpineBase", "SpineShoulder", 0, 0.045),
    ("SpineShoulder", "Head", 1, 0.04),
    *(
        (f"{start}{side}", f"{end}{side}", bone, spread)
        for start, end, bone, spread in (
            ("Shoulder", "Elbow", 2, 0.07),
            ("Elbow", "Wrist", 3, 0.065),
            ("Hip", "Knee", 4, 0.065),
            ("Knee", "Ankle", 5, 0.065),
        )
        for side in ("Left", "Right")
    ),
)
"""Start, end, bone (left and right are one), and the standard deviation of its logarithm over views."""
BONES: Final = 6
STARTS: Final = np.array([INDEX[start] for start, _, _, _ in _PAIRS])
ENDS: Final = np.array([INDEX[end] for _, end, _, _ in _PAIRS])
BONE: Final = np.array([bone for _, _, bone, _ in _PAIRS])
SPREAD: Final[Floats] = np.array([next(s for _, _, b, s in _PAIRS if b == bone) for bone in range(BONES)])  # (6,)
MOST_DEVIATIONS: Final = 4.0
"""A single bone, lost or mistaken, counts at most this much."""
FEWEST_BONES: Final = 4
ENOUGH_FRAMES: Final = 20.0
SHORTEST_M: Final = 0.01
TRACKED: Final = TrackingState.TRACKED


@dataclass(frozen=True, slots=True)
class Signature:
    """Mean logarithms of bone lengths (m), and over how many frames each was seen."""

    log_m: Floats  # (6,)
    frames: Floats  # (6,)

    @staticmethod
    def unknown() -> Signature:
        """Before anything was seen."""
        return Signature(np.zeros(BONES), np.zeros(BONES))

    def after(self, positions: Floats, state: States, memory_frames: float) -> Signature:
        """With one more frame (25, 3), (25,); a mean over all at first, over the last `memory_frames` later."""
        return Signature(*_renewed(self.log_m, self.frames, positions, state, memory_frames))

    def misfit(self, other: Signature) -> float:
        """Root mean square difference in standard deviations; 0 while too little is known of either to say anything."""
        return float(_misfit(self.log_m, self.frames, other.log_m, other.frames))


@kernel
def _renewed(log_m: Floats, frames: Floats, positions: Floats, state: States, memory: float) -> tuple[Floats, Floats]:
    total, count = np.zeros(BONES), np.zeros(BONES)
    for k in range(len(STARTS)):
        a, b = STARTS[k], ENDS[k]
        if state[a] == TRACKED and state[b] == TRACKED:
            total[BONE[k]] += log(max(apart(positions[a], positions[b]), SHORTEST_M))
            count[BONE[k]] += 1.0
    new_log_m, new_frames = log_m.copy(), frames.copy()
    for bone in range(BONES):
        if count[bone] > 0.0:
            new_frames[bone] = min(frames[bone] + 1.0, memory)
            new_log_m[bone] += (total[bone] / count[bone] - log_m[bone]) / new_frames[bone]
    return new_log_m, new_frames


@kernel
def _misfit(log_m: Floats, frames: Floats, other_log_m: Floats, other_frames: Floats) -> float:
    squares, known = 0.0, 0
    for bone in range(BONES):
        if min(frames[bone], other_frames[bone]) >= ENOUGH_FRAMES:
            away = min(abs(log_m[bone] - other_log_m[bone]) / SPREAD[bone], MOST_DEVIATIONS)
            squares += away * away
            known += 1
    return sqrt(squares / known) if known >= FEWEST_BONES else 0.0
