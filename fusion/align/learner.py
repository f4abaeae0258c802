"""Learns one sensor's alignment while frames come in: searches, deepens, goes on, and notices when it was moved."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from fusion.align.alignment import SensorAlignment
from fusion.align.plausible import Fault, handedness_fault
from fusion.align.space import Moments, RobustFit, fit_robustly
from fusion.align.space_time import (
    CORRELATION_STD_S,
    alignment_of,
    clear_offset,
    fit_space_time,
    mounting_of,
    offset_step,
    refine,
)
from fusion.align.track import BodyTrack, Pairs, pair

WINDOW_S = 10.0
"""Frames are re-weighed together for this long; older ones live on as sums."""
EVERY_S = 0.5
SETTLE_EVERY_S = 2.0
MEMORY_S = 60.0
"""Settled frames fade with this time constant, so that a tripod that sinks or a clock that drifts is followed.
Time counts as far as the patient moved."""
NEW_POSE_M, LEAST_NEWS = 0.5, 0.05
"""A look in which the joints went this far on average counts fully once it is settled. Somebody who stands still shows
the same errors over and over: ten seconds of that turned a sensor by 12° and would weigh down all that comes later."""
LONGEST_OFFSET_S = 0.5
"""Live, the receive clock is common; what is left is the difference of two senders' delays."""
LEARNING_FRAMES = 60
"""Reference frames looked at in one go: what a tick can afford."""
FEWEST_FRAMES = 30
LARGEST_ROTATION_STD_RAD = np.radians(5.0)
LARGEST_POSITION_STD_M = 0.03
LARGEST_RESIDUAL_M = 0.12
MOVED_FACTOR, MOVED_LEAST_M, MOVED_AFTER_S = 3.0, 0.15, 1.5


@dataclass(frozen=True, slots=True)
class _Settled:
    """What was learnt from frames that have left the window."""

    moments: Moments
    offset_information: float
    """1/s²."""
    until_s: float
    """Reference frames up to here have been taken in."""
    frames: int


class AlignmentLearner:
    """One sensor against the reference; both tracks on the receive clock, the patient's body in each."""

    def __init__(self) -> None:
        self.alignment: SensorAlignment | None = None
        """The alignment once it is well determined."""
        self.fault: Fault | None = None
        self.moved = False
        """Whether the sensor was found moved and is being learnt anew."""
        self._settled: _Settled | None = None
        self._not_before_s = self._looked_s = -np.inf
        self._first_s: float | None = None
        self._speeds_offset_s = 0.0
        """What the speeds say of the offset; none, as long as nobody has moved enough for them to say it."""

    def learn(self, reference: BodyTrack, sensor: BodyTrack) -> None:
        """Take the last `WINDOW_S` of both tracks; call it about every `EVERY_S`."""
        reference = reference.since(self._not_before_s)
        if min(len(reference.t_s), len(sensor.t_s)) < FEWEST_FRAMES or reference.t_s[-1] <= self._looked_s:
            return
        self._looked_s = float(reference.t_s[-1])
        if self.alignment is None:
            self._search(reference, sensor)
        elif self._settled is None:
            self._deepen(reference, sensor, self.alignment)
        else:
            self._go_on(reference, sensor, self.alignment, self._settled)

    def _search(self, reference: BodyTrack, sensor: BodyTrack) -> None:
        """Look for mounting and offset from nothing."""
        found = fit_space_time(reference, sensor, LONGEST_OFFSET_S, candidates=2, rounds=4, most=LEARNING_FRAMES)
        if found is None or found.frames < FEWEST_FRAMES:
            return
        pairs = pair(reference, sensor, found.clock_offset_s, LEARNING_FRAMES // 2)
        self.fault = handedness_fault(pairs)
        if self.fault is None and trusted(found):
            self.alignment, self.moved = found, False
            self._first_s = float(reference.t_s[0])

    def _deepen(self, reference: BodyTrack, sensor: BodyTrack, now: SensorAlignment) -> None:
        """While the first frames are still in the window, weigh all of them anew; settle them when it is full."""
        clear_s = clear_offset(reference, sensor, LONGEST_OFFSET_S)
        self._speeds_offset_s = self._speeds_offset_s if clear_s is None else clear_s
        prior_s = self._speeds_offset_s
        better = refine(reference, sensor, now.clock_offset_s, 2, LEARNING_FRAMES, mounting_of(now), prior_s)
        if better is not None and trusted(better):
            self.alignment = better
        if reference.t_s[-1] - (self._first_s or reference.t_s[0]) > WINDOW_S - SETTLE_EVERY_S:
            pairs, fit = self._fit(reference, sensor, self.alignment or now, None)
            step = offset_step(pairs, fit.mounting, pairs.weight)
            self._settled = _Settled(
                fit.moments(pairs).faded(_news(reference)),
                step.information + 1.0 / CORRELATION_STD_S**2,
                float(reference.t_s[-1]) - 0.3,
                pairs.frames,
            )

    def _go_on(self, reference: BodyTrack, sensor: BodyTrack, now: SensorAlignment, settled: _Settled) -> None:
        """Recursion: the new frames on top of the settled sums."""
        fresh = reference.since(settled.until_s)
        if len(fresh.t_s) < 2 or fresh.t_s[-1] - settled.until_s < SETTLE_EVERY_S:
            return
        pairs = pair(fresh, sensor, now.clock_offset_s, LEARNING_FRAMES)
        if pairs.frames < FEWEST_FRAMES // 2:
            self._settled = _Settled(settled.moments, settled.offset_information, float(fresh.t_s[-1]), settled.frames)
            return
        if self._was_moved(pairs, now, float(fresh.t_s[-1])):
            return
        pairs, fit = self._fit(fresh, sensor, now, settled.moments)
        step = offset_step(pairs, fit.mounting, np.where(fit.swapped[:, None], 0.0, pairs.weight))
        share = step.information / max(step.information + settled.offset_information, 1e-9)
        news = _news(fresh)
        fade = float(np.exp(-news * (fresh.t_s[-1] - settled.until_s) / MEMORY_S))
        frames = settled.frames + pairs.frames
        self.alignment = _renewed(now, fit, now.clock_offset_s + share * step.change_s, frames)
        self._settled = _Settled(
            settled.moments.faded(fade).joined(fit.moments(pairs).faded(news)),
            (settled.offset_information + step.information) * fade,
            float(fresh.t_s[-1]) - 0.3,
            frames,
        )

    def _fit(
        self, reference: BodyTrack, sensor: BodyTrack, now: SensorAlignment, settled: Moments | None
    ) -> tuple[Pairs, RobustFit]:
        pairs = pair(reference, sensor, now.clock_offset_s, LEARNING_FRAMES)
        return pairs, fit_robustly(pairs, settled, start=mounting_of(now))

    def _was_moved(self, pairs: Pairs, now: SensorAlignment, t_s: float) -> bool:
        """Whether the recent joints are far apart as aligned but agree under another mounting; then learn anew."""
        distance = np.linalg.norm(mounting_of(now).errors(pairs), axis=2)[pairs.weight > 0]
        median = float(np.median(distance))
        if median < max(MOVED_FACTOR * now.residual_m, MOVED_LEAST_M):
            return False
        if fit_robustly(pairs).residual_m > 0.5 * median:
            return False
        self.alignment, self._settled, self.moved = None, None, True
        self._not_before_s = t_s - MOVED_AFTER_S
        return True


def trusted(found: SensorAlignment) -> bool:
    """Whether an alignment is determined well enough to move an arm by."""
    return (
        found.rotation_std_rad < LARGEST_ROTATION_STD_RAD
        and found.position_std_m < LARGEST_POSITION_STD_M
        and found.residual_m < LARGEST_RESIDUAL_M
    )


def _renewed(now: SensorAlignment, fit: RobustFit, offset_s: float, frames: int) -> SensorAlignment:
    """The new fit, its residual smoothed: one block of frames says little about it."""
    found = alignment_of(fit, offset_s, frames)
    residual = now.residual_m + 0.1 * (fit.residual_m - now.residual_m)
    return replace(found, residual_m=residual)


def _news(track: BodyTrack) -> float:
    """How much a look adds to what was known, from next to nothing (standing still) to 1."""
    return float(np.clip(track.path_m() / NEW_POSE_M, LEAST_NEWS, 1.0))
