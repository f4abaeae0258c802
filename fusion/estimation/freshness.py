"""How long a joint counts as seen, how long its motion may be continued, and when it is lost."""

from __future__ import annotations

from math import isfinite
from typing import Final

import numpy as np

from fusion.compiled import kernel
from fusion.messages import Floats, States
from fusion.skeleton import TrackingState

SEEN_WITHIN_S: Final = 0.05
"""A joint measured this recently is state 2."""
CONTINUE_S: Final = 0.1
"""Motion is continued for three frames of silence and no longer (SR-4); after that the joint is held."""
LOST_AFTER_S: Final = 1.0
"""A joint silent for longer is state 0; its last position is still given."""
TOO_OLD_S: Final = 0.4
"""A sample older than the state by more than this is ignored."""
TRACKED, INFERRED, LOST = TrackingState.TRACKED, TrackingState.INFERRED, TrackingState.LOST


def counts(t_s: float, newest_s: float) -> bool:
    """Whether a sample of `t_s` still counts after one of `newest_s`; an instant that is not a number does not."""
    return isfinite(t_s) and t_s >= newest_s - TOO_OLD_S


@kernel
def states_of(seen_s: Floats, t_s: float) -> States:
    """(J,) `state_of` every joint."""
    states = np.empty(len(seen_s), np.uint8)
    for j in range(len(seen_s)):
        states[j] = state_of(seen_s[j], t_s)
    return states


@kernel
def state_of(seen_s: float, t_s: float) -> int:
    """2 seen within 50 ms, 1 held or predicted, 0 lost or never seen (`seen_s` = -inf)."""
    age_s = t_s - seen_s
    if age_s <= SEEN_WITHIN_S:
        return TRACKED
    return INFERRED if age_s <= LOST_AFTER_S else LOST


@kernel
def seconds_in_motion(seen_s: float, from_s: float, to_s: float) -> float:
    """The part of `from_s`..`to_s` in which a joint last seen at `seen_s` may still be moved on."""
    return max(min(to_s, seen_s + CONTINUE_S) - from_s, 0.0)
