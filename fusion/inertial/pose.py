"""The calibration pose: the arm hangs still, so gravity runs along every segment."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fusion.errors import InputError
from fusion.geometry import Floats
from fusion.inertial.orientation import Oriented

LENGTH_S: Final = 2.0
SEARCHED_S: Final = 10.0
"""Unless told otherwise the pose is looked for in the first seconds."""
STILL_RAD_S: Final = 0.25
"""Root mean square of the angular velocity below which somebody stands still (people sway)."""
EDGE: Final = 1e-6


@dataclass(frozen=True, slots=True)
class Pose:
    """When the arm hung still."""

    from_s: float
    to_s: float

    def at(self, t_s: Floats) -> NDArray[np.bool_]:
        """The samples of the pose, (T,)."""
        inside: NDArray[np.bool_] = (t_s >= self.from_s - EDGE) & (t_s <= self.to_s + EDGE)
        return inside

    def up(self, segment: Oriented) -> Floats:
        """A segment's long axis, from distal to proximal, in its sensor, (3,): where up was while the arm hung."""
        mean = segment.up[self.at(segment.t_s)].mean(axis=0)
        unit: Floats = mean / np.linalg.norm(mean)
        return unit


def find_pose(segments: Sequence[Oriented]) -> Pose:
    """The stillest two seconds at the beginning.

    Raises:
        InputError: nobody stands still there.
    """
    t_s = segments[0].t_s
    squares = np.mean([np.sum(segment.rate_rad_s**2, axis=1) for segment in segments], axis=0)
    count = max(2, round(LENGTH_S / float(t_s[1] - t_s[0])))
    searched = squares[: np.searchsorted(t_s, t_s[0] + SEARCHED_S)]
    if len(searched) < count:
        raise InputError("the recording is too short", f"{LENGTH_S:.0f} s of hanging arms", "record the pose too")
    means = np.convolve(searched, np.ones(count) / count, mode="valid")
    start = int(means.argmin())
    _refuse_moving(float(np.sqrt(means[start])))
    return Pose(float(t_s[start]), float(t_s[start + count - 1]))


def checked_pose(segments: Sequence[Oriented], from_s: float, to_s: float) -> Pose:
    """A pose that somebody named.

    Raises:
        InputError: the recording does not hold it, or the arm moved.
    """
    pose = Pose(from_s, to_s)
    inside = pose.at(segments[0].t_s)
    if inside.sum() < 2:
        t_s = segments[0].t_s
        has = f"times between {t_s[0]:.2f} and {t_s[-1]:.2f} s"
        raise InputError(f"there is no pose from {from_s:g} to {to_s:g} s", has, "mend --pose")
    _refuse_moving(float(np.sqrt(np.mean([np.sum(s.rate_rad_s[inside] ** 2, axis=1) for s in segments]))))
    return pose


def _refuse_moving(rate_rad_s: float) -> None:
    if rate_rad_s > STILL_RAD_S:
        what = f"the arm is never still in the calibration pose ({rate_rad_s:.2f} rad/s)"
        raise InputError(what, "two seconds with hanging arms", "say when they hung: --pose FROM TO")
