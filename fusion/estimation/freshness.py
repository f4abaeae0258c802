"""How long a joint counts as seen, how long its motion may be continued, and when it is lost."""

from __future__ import annotations

from typing import Final

import numpy as np

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


def state_of(seen_s: Floats, t_s: float) -> States:
    """(J,) 2 seen within 50 ms, 1 held or predicted, 0 lost or never seen (`seen_s` = -inf)."""
    age_s = t_s - seen_s
    held = np.where(age_s <= LOST_AFTER_S, TrackingState.INFERRED, TrackingState.LOST)
    return np.where(age_s <= SEEN_WITHIN_S, TrackingState.TRACKED, held).astype(np.uint8)


def seconds_in_motion(seen_s: Floats, from_s: float, to_s: float) -> Floats:
    """(J,) s, the part of `from_s`..`to_s` in which a joint last seen at `seen_s` may still be moved on."""
    return np.clip(np.minimum(to_s, seen_s + CONTINUE_S) - from_s, 0.0, None)
