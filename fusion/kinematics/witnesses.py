"""How far each sensor, by itself, was from the told arm: bounds of the angles learnt from what is seen.

The joints' sets (`direction_sets`) add the errors of both ends of a segment as if they had nothing to do with each
other, and must allow for all that a depth camera may do to a joint. But shoulder, elbow and wrist of one sensor at one
instant err together, and a direction is steadier than its ends. Two things that are seen all the time say how much:

- every sensor's own segments, held against the told ones of that instant. As for the joints' balls, the bound is the
  worst disagreement of late, what no disagreement can show, and what an acceleration can have added since;
- what is usual: no error is more than a few times as large as the usual disagreement, or as the usual misfit of the
  forearm in the sensors' samples, whose length is constant, so that one sensor alone shows it as well.

The larger one counts. Assumptions and measurements: docs/angles.md.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, field
from math import exp, inf, isnan, nan, pi, sin
from typing import Final

import numpy as np

from fusion.compiled import kernel
from fusion.kinematics.angles import ARM_JOINTS, OUTWARD, Joints, PerAngle, pose_of, to_limb, wrapped
from fusion.kinematics.lately import Lately
from fusion.kinematics.vectors import Vector, angle_between, length, step, sum_of, unit
from fusion.messages import AlignedSample, Floats, FusedFrame, TrunkFrame
from fusion.skeleton import Side, TrackingState

START_RAD: Final = 0.7
"""The worst disagreement before there was any: an error of 0.2 m [Du2016 Table 1] across a segment of 0.28 m."""
FORGET_S: Final = 0.5
"""A disagreement fades at this rate."""
MEMORY: Final = 900
"""Disagreements remembered for what is usual: a quarter of a minute of two sensors."""
AGREED_WITHIN_S: Final = 0.25
"""Sensors that saw the arm within this time of now confirm one another; a late sensor's word is that old."""
ACCELERATION_RAD_S2: Final = 75.0
"""20 m/s² across a segment of 0.27 m."""
TOLD_COUNT: Final = 64
"""Told arms remembered: more than half a second at 100 Hz, older than any sample that is still taken."""
LONGEST_GAP_S: Final = 0.15
"""Between told arms further apart than this none is made up."""


AGREED: Final = PerAngle(0.19, 0.16, 0.16)
"""Errors that two sensors share, which no disagreement shows."""
ALONE: Final = PerAngle(0.25, 0.33, 0.33)
"""What one sensor, held against nothing but its own past, does not show."""
USUAL_APART: Final = PerAngle(4.0, 5.0, 6.0)
USUAL_MISFITS: Final = PerAngle(6.5, 7.0, 8.0)
"""No angle errs by more than this many usual disagreements, or usual misfits of the forearm as a share of it.

With errors of equal size in every direction a standard deviation is 1.5 misfits: 4.3 of the two that make the swing;
both other angles feel the elbow's error twice. Told arms err less than the samples that show it.
"""
DOUBTS: Final = 15
DOUBTED: Final = 0.8
"""So many misfits of so large a size, 0.2 m [Du2016 Table 1] of 0.25 m, are believed in before any was seen: a few
samples that agree say little of what is usual."""
SMALL_RAD: Final = 0.7
"""Larger than this, errors are no longer small, and nothing that is learnt from them is believed."""


@dataclass(slots=True)
class _Word:
    """When a sensor was last heard."""

    taken_s: float = -inf
    upper_s: float = -inf
    """It saw the upper arm."""
    whole_s: float = -inf
    """It saw the whole arm."""
    forearms_m: Lately = field(default_factory=lambda: Lately(MEMORY))
    """How long it saw the forearm. Its own usual length counts: one that sees forearms too short errs in no angle."""

    def misfit(self, forearm_m: float) -> float:
        """How much a forearm is longer or shorter than the sensor's usual one, as a share of that."""
        self.forearms_m.take(forearm_m)
        usual_m = self.forearms_m.median
        return abs(forearm_m - usual_m) / usual_m


class Witnesses:
    """Holds every sensor's arm against the told one, tick by tick. Memory is finite."""

    def __init__(self) -> None:
        self._told = np.full((TOLD_COUNT, 7), -inf)  # time, upper arm, forearm in the room
        self._at = 0
        self._words: defaultdict[str, _Word] = defaultdict(_Word)
        self._worst = [START_RAD] * 3  # as in `PerAngle`
        self._usual = (Lately(MEMORY), Lately(MEMORY), Lately(MEMORY))
        self._misfits = Lately(MEMORY)
        for _ in range(DOUBTS):
            self._misfits.take(DOUBTED)
        self._faded_s = inf

    def hear(self, frame: FusedFrame, trunk: TrunkFrame, side: Side, samples: tuple[AlignedSample, ...]) -> PerAngle:
        """Take what the sensors say of the told arm.

        Args:
            frame: the told body; its refusals are those of `samples`.
            trunk: its trunk.
            side: which arm.
            samples: the latest of every sensor; each is taken once.

        Returns:
            The bounds at the frame's time.
        """
        joints = ARM_JOINTS[side]
        self._fade(frame.t_s)
        self._at = _note(self._told, self._at, frame.t_s, frame.positions_in_room, joints)
        for sample in samples:
            word = self._words[sample.sensor]
            if sample.t_s > word.taken_s:
                word.taken_s = sample.t_s
                self._judge(sample, word, _seen(sample, frame, joints), (trunk, side))
        return self._bounds(frame.t_s)

    def _fade(self, t_s: float) -> None:
        left = exp(-max(t_s - self._faded_s, 0.0) / FORGET_S)
        self._worst = [worst * left for worst in self._worst]
        self._faded_s = t_s

    def _judge(self, sample: AlignedSample, word: _Word, seen: int, body: tuple[TrunkFrame, Side]) -> None:
        """`seen`: how many joints of the arm, from the shoulder on, the sensor saw and was believed in."""
        if seen < 2:
            return
        trunk, side = body
        axes, outward, joints = trunk.rotation_trunk_to_room, OUTWARD[side], ARM_JOINTS[side]
        apart = _apart(self._told, self._at, sample.t_s, sample.positions_in_room, axes, outward, joints)
        if isnan(apart[0]):
            return
        word.upper_s = sample.t_s
        self._learn(0, apart[0], apart[0])
        if seen == 3:
            word.whole_s = sample.t_s
            misfit = word.misfit(apart[3])
            self._misfits.take(misfit)
            self._learn(1, apart[1], max(apart[1], misfit))  # a wrist that wanders off shows in the length first
            self._learn(2, apart[2], max(apart[2], misfit))

    def _learn(self, angle: int, apart: float, shown: float) -> None:
        self._usual[angle].take(apart)
        self._worst[angle] = max(self._worst[angle], shown)

    def _bounds(self, t_s: float) -> PerAngle:
        upper = _doubt([word.upper_s for word in self._words.values()], t_s)
        whole = _doubt([word.whole_s for word in self._words.values()], t_s)
        usual = self._misfits.median
        return PerAngle(
            self._believed(0, upper.swing, usual),
            self._believed(1, whole.elbow, usual),
            self._believed(2, whole.turn, usual),
        )

    def _believed(self, angle: int, hidden: float, misfit: float) -> float:
        by_sensors = USUAL_APART[angle] * self._usual[angle].median
        bound = max(self._worst[angle] + hidden, by_sensors, USUAL_MISFITS[angle] * misfit)
        return bound if bound <= SMALL_RAD else pi


def _doubt(heard_s: list[float], t_s: float) -> PerAngle:
    """What is hidden from those who saw the arm lately, and what an acceleration may have added since."""
    silence_s = max(t_s - max(heard_s, default=-inf), 0.0)
    agreed = len([heard for heard in heard_s if t_s - heard <= AGREED_WITHIN_S]) > 1
    added = 0.5 * ACCELERATION_RAD_S2 * silence_s**2
    swing, elbow, turn = AGREED if agreed else ALONE
    return PerAngle(swing + added, elbow + added, turn + added)


def _seen(sample: AlignedSample, frame: FusedFrame, joints: Joints) -> int:
    """How many joints of the arm, from the shoulder on, are tracked and were not refused."""
    refused = {refusal.joint for refusal in frame.refusals if refusal.sensor == sample.sensor}
    for count, joint in enumerate(joints):
        if sample.state[joint] != TrackingState.TRACKED or joint in refused:
            return count
    return len(joints)


@kernel
def _note(told: Floats, at: int, t_s: float, positions: Floats, joints: Joints) -> int:
    """Write the told arm behind the last one, or over it if time stands still; returns its row."""
    shoulder, elbow, wrist = joints
    if t_s > told[at, 0]:
        at = (at + 1) % TOLD_COUNT
    upper, forearm = step(positions, shoulder, elbow, 1.0), step(positions, elbow, wrist, 1.0)
    told[at, 0] = t_s
    for k in range(3):
        told[at, 1 + k], told[at, 4 + k] = upper[k], forearm[k]
    return at


@kernel
def _apart(
    told: Floats, at: int, t_s: float, positions: Floats, axes: Floats, outward: float, joints: Joints
) -> tuple[float, float, float, float]:
    """How far a sensor's arm is from the told one at `t_s`: swing, elbow, the forearm's turn; and its forearm's length.

    The turn about the upper arm is the difference in twist times the sine of the told flexion: an arc that stays small
    for a straight elbow, whose twist means nothing. NaN where no arm was told then.
    """
    shoulder, elbow, wrist = joints
    upper, forearm = _told_at(told, at, t_s)
    true = pose_of(unit(to_limb(upper, axes, outward)), unit(to_limb(forearm, axes, outward)))
    seen_upper = unit(to_limb(step(positions, shoulder, elbow, 1.0), axes, outward))
    seen_forearm = to_limb(step(positions, elbow, wrist, 1.0), axes, outward)
    seen = pose_of(seen_upper, unit(seen_forearm))
    swing = angle_between(seen.upper, true.upper)
    turn = abs(wrapped(seen.twist - true.twist)) * sin(true.flexion)
    return swing, abs(seen.flexion - true.flexion), turn, length(seen_forearm)


@kernel
def _told_at(told: Floats, at: int, t_s: float) -> tuple[Vector, Vector]:
    """The told segments at `t_s`, between the told ones before and after it; NaN before the first."""
    later = at
    for back in range(TOLD_COUNT - 1):
        earlier = (at - back) % TOLD_COUNT
        if told[earlier, 0] <= t_s:
            return _mixed(told, earlier, later, t_s)
        later = earlier
    return (nan, nan, nan), (nan, nan, nan)


@kernel
def _mixed(told: Floats, earlier: int, later: int, t_s: float) -> tuple[Vector, Vector]:
    gap_s = told[later, 0] - told[earlier, 0]
    share = (t_s - told[earlier, 0]) / gap_s if gap_s > 0.0 else 0.0
    if gap_s > LONGEST_GAP_S:
        share = 1.0
    a, b = told[earlier], told[later]
    upper = sum_of(a[1:4], sum_of(b[1:4], a[1:4], -1.0), share)
    return upper, sum_of(a[4:7], sum_of(b[4:7], a[4:7], -1.0), share)
