"""How far the healthy arm has shown that the affected one shall go, measured while the session is prepared."""

from __future__ import annotations

from math import degrees, pi, radians

import numpy as np

from db.limits import JointRange, PassiveRange
from server.api.game_forms import WorkspaceShown
from server.messages import EXO_JOINTS, ArmView, DriveState, LiveTick

BINS_PER_JOINT = 360
"""One degree each, from −180° on: counted so that an hour of showing takes no more memory than a second."""
ROBUST_SHARES = (0.02, 0.98)
"""Ends of what was shown; the rest at both ends is noise and swing."""
LEAST_ELEVATION_RAD = radians(15.0)
"""Of an arm that hangs lower, plane and rotation say little: a small sway turns them all the way round."""
ENOUGH_S = 10.0
ENOUGH_RAD = {
    "plane": radians(25.0),
    "elevation": radians(25.0),
    "rotation": radians(15.0),
    "elbow": radians(25.0),
}
"""What every joint must have shown."""
LONGEST_S = 0.1
"""A longer gap between two ticks counts as this much."""
OF_A_RAISED_ARM = ("plane", "rotation")


class WorkspaceMeter:
    """Counts the mirrored arm's angles while the drive does not move the affected one."""

    def __init__(self) -> None:
        self._counts = np.zeros((len(EXO_JOINTS), BINS_PER_JOINT), dtype=np.int64)
        self._seen_s = 0.0
        self._t_s: float | None = None

    def take(self, tick: LiveTick) -> None:
        """Take a tick."""
        before, self._t_s = self._t_s, tick.t_s
        arm = tick.target
        if arm is None or not arm.valid or tick.state is DriveState.ENGAGED:
            return
        self._seen_s += 0.0 if before is None else min(max(tick.t_s - before, 0.0), LONGEST_S)
        for row, name in enumerate(EXO_JOINTS):
            if name not in OF_A_RAISED_ARM or arm.elevation_rad >= LEAST_ELEVATION_RAD:
                self._counts[row, _bin_of(arm, name)] += 1

    def read(self) -> WorkspaceShown:
        """What has been shown so far, and what is still missing."""
        shown = {name: _shown(counts) for name, counts in zip(EXO_JOINTS, self._counts, strict=True)}
        missing = [name for name, joint in shown.items() if joint is None or _span_rad(joint) < ENOUGH_RAD[name]]
        return WorkspaceShown(
            seen_s=self._seen_s,
            shown=None if None in shown.values() else PassiveRange.model_validate(shown),
            missing=missing,
            enough=not missing and self._seen_s >= ENOUGH_S,
        )


def _bin_of(arm: ArmView, joint: str) -> int:
    angle_rad = getattr(arm, f"{joint}_rad")
    return min(max(int(degrees(angle_rad) + BINS_PER_JOINT // 2), 0), BINS_PER_JOINT - 1)


def _shown(counts: np.ndarray[tuple[int], np.dtype[np.int64]]) -> JointRange | None:
    """The robust ends of what was counted, to a degree; None where nothing was."""
    total = int(counts.sum())
    if total == 0:
        return None
    low, high = np.searchsorted(np.cumsum(counts) / total, ROBUST_SHARES)
    return JointRange(min_rad=_edge_rad(int(low)), max_rad=_edge_rad(int(high) + 1))


def _edge_rad(bin_number: int) -> float:
    return min(max(radians(bin_number - BINS_PER_JOINT // 2), -pi), pi)


def _span_rad(joint: JointRange) -> float:
    return joint.max_rad - joint.min_rad
