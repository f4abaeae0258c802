"""The default: a set that holds each joint whatever sensors and limbs do within their bounds, and a point inside it.

The stable form of [Du2016 §2.4]. Every believed measurement is a box in range, azimuth and elevation
that cuts the set; a bound of ±0.2 m refuses nothing below half a metre, so the point is the mean of a gated filter
that knows each sensor's bias and takes only what is believed, or what agrees with it. The body that is told keeps the
lengths of its bones.

All that is known is one record per joint, one per joint and sensor and one per bone (`known.py`). Kernels change
records in place, but only those of copies that they make first: a state once told never changes.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from typing import ClassVar, Final

import numpy as np

from fusion.compiled import Record, Records, kernel
from fusion.estimation import ball, biased_filter, bones, build, gated_filter, motion_set, occlusion, refusals, trust
from fusion.estimation.estimator import Estimator
from fusion.estimation.evidence import Evidence, weigh
from fusion.estimation.freshness import CONTINUE_S, LOST_AFTER_S, counts, state_of
from fusion.estimation.gated_filter import GATE_SIGMA
from fusion.estimation.known import Known, acquainted, copied, nothing
from fusion.estimation.measurement import Heard, Measurement, Sight, read, sight
from fusion.estimation.vectors import Vector, length, plus, row
from fusion.messages import AlignedSample, Flags, Floats, FusedFrame, Refusal, States
from fusion.skeleton import JOINT_COUNT

REASONS: Final = (
    "",
    "bone length changed",
    "in doubt, another sensor is sure",
    f"beyond {GATE_SIGMA:g} sigma",
    "does not meet the set",
    "hidden behind the trunk",
)
TAKEN, BONE, DOUBT, GATE, SET, HIDDEN = range(len(REASONS))


@dataclass(frozen=True, slots=True)
class SetState:
    """All that the estimator knows at `t_s`."""

    t_s: float
    sensors: tuple[str, ...]
    known: Known
    latest: refusals.Latest


class SetMembership(Estimator):
    """Gated mean inside a set under bounded error, acceleration and speed.

    Args:
        joints: how many; the bones between them are those of `fusion.skeleton`.
    """

    name: ClassVar[str] = "set-membership"

    def __init__(self, joints: int = JOINT_COUNT) -> None:
        self._state = SetState(-np.inf, (), nothing(joints), ())

    def update(self, sample: AlignedSample) -> tuple[Refusal, ...]:
        """Judge the sample, cut the set with what is believed of it, and move the point."""
        if not counts(sample.t_s, self._state.t_s):
            return ()
        self._state, refused = _updated(self._state, sample)
        return refused

    def frame(self, t_s: float) -> FusedFrame:
        """The filter's mean inside the set, its bones as long as ever; the farthest point of set and ball from it."""
        state = self._state
        told = _tell(state.known, state.t_s, float(t_s))
        return FusedFrame(t_s, *told, refusals.fresh(state.latest, t_s))

    def snapshot(self) -> object:
        """The estimator's state."""
        return self._state

    def restore(self, snapshot: object) -> None:
        """Go back to an earlier state."""
        if not isinstance(snapshot, SetState):
            raise TypeError(f"a snapshot of {self.name} is a SetState, not {type(snapshot).__name__}")
        self._state = snapshot


def _updated(state: SetState, sample: AlignedSample) -> tuple[SetState, tuple[Refusal, ...]]:
    is_new = sample.sensor not in state.sensors
    sensors = (*state.sensors, sample.sensor) if is_new else state.sensors
    before = acquainted(state.known) if is_new else state.known
    own, at_s = sensors.index(sample.sensor), float(sample.t_s)
    t_s = max(at_s, state.t_s)
    known, codes = _take(before, own, sight(sample, len(before.joints)), state.t_s, t_s, t_s - at_s)
    refused = refusals.refused(sample.sensor, codes, REASONS)
    latest = refusals.remember(state.latest, sample.sensor, at_s, refused)
    return SetState(t_s, sensors, known, latest), refused


@kernel
def _take(
    before: Known, own: int, seen: Sight, from_s: float, t_s: float, late_s: float
) -> tuple[Known, refusals.Codes]:
    """Move all joints from `from_s` to `t_s`, take what sensor `own` measured `late_s` before.

    Returns what is known after, and what was refused of each joint.
    """
    known = copied(before)
    for j in range(len(known.joints)):
        biased_filter.predict(known.joints[j], known.words[j], from_s, t_s)
        motion_set.move(known.joints[j], t_s - from_s)
    measured = read(seen)
    wandering = bones.judge(known.bones[1 + own], measured)
    lens = (seen.lens_in_room[0], seen.lens_in_room[1], seen.lens_in_room[2])
    codes, room = np.zeros(len(known.joints), np.uint8), np.empty(known.words.shape[1])
    for j in range(len(known.joints)):
        if measured.given[j]:
            joint, words, bias_m2 = known.joints[j], known.words[j], known.bias_m2[j]
            heard = _heard(measured, wandering, j, lens, known.joints)
            evidence = weigh(heard, lens, seen.rotation_sensor_to_room, joint, words, bias_m2, own, t_s, late_s)
            code = _use(joint, words, bias_m2, own, evidence, t_s, room)
            codes[j] = _why(heard) if evidence.outvoted else code
    build.learn(known.bones[0], known.joints, t_s)
    return known, codes


@kernel
def _heard(measured: Measurement, wandering: Flags, j: int, lens: Vector, joints: Records) -> Heard:
    """What one sample says of joint `j`; `joints` (J,) are where all are expected."""
    place, top, spine_seen = row(measured.positions, j), occlusion.TOP, False
    hidden, from_spine = False, (0.0, 0.0, 0.0)
    if len(joints) >= occlusion.SPINE_JOINTS:
        spine_seen = measured.given[top]
        from_spine = plus(place, row(measured.positions, top), -1.0)
        if occlusion.HIDES[j % len(occlusion.HIDES)]:
            hidden = occlusion.hides(lens, place, joints[j], joints[top], joints[occlusion.BOTTOM])
    return Heard(place, measured.tracked[j], wandering[j], hidden, from_spine, spine_seen)


@kernel
def _why(heard: Heard) -> int:
    """The reason for which an outvoted word is in doubt."""
    if heard.wandering:
        return BONE
    return HIDDEN if heard.hidden else DOUBT


@kernel
def _use(joint: Record, words: Records, bias_m2: Floats, own: int, evidence: Evidence, t_s: float, room: Floats) -> int:
    """Take one joint's evidence if it fits what was expected; the reason where it does not."""
    unbiased = plus(evidence.position, words[own].offset_m, -1.0)
    off = plus(unbiased, joint.position, -1.0)
    near = biased_filter.sigmas_off(joint, words, bias_m2, own, off, evidence.variance) <= GATE_SIGMA
    if evidence.outvoted:
        if near:
            biased_filter.learn_bias(joint, words, bias_m2, own, off, evidence.variance)
        return DOUBT
    tried = near or evidence.unchecked
    met = tried and motion_set.take(joint, evidence.measured, evidence.half_width)
    begun = gated_filter.insists(joint, met, t_s) or not t_s - joint.seen_s < LOST_AFTER_S
    if not (met or begun):
        return SET if tried else GATE
    _believe(joint, words, own, evidence, begun, t_s)
    if near and not begun and t_s - joint.seen_s <= CONTINUE_S:
        biased_filter.correct(joint, words, bias_m2, own, off, evidence.variance, t_s, room)
    else:
        # After a silence the point was held: how far it is off is no velocity.
        biased_filter.start(joint, words, bias_m2, own, unbiased, evidence.variance, t_s)
    if begun:
        motion_set.begin(joint, evidence.measured, evidence.half_width)
    return TAKEN


@kernel
def _believe(joint: Record, words: Records, own: int, evidence: Evidence, begun: bool, t_s: float) -> None:
    """Remember when a sensor was last believed, and how far from the point it was then."""
    if evidence.believed:
        if not begun:
            ball.learn(joint, evidence.apart_m, evidence.shared, t_s - trust.last_believed_s(words))
        words[own].believed_s = t_s


@kernel
def _tell(known: Known, from_s: float, t_s: float) -> tuple[Floats, Floats, Floats, States]:
    """Positions (J, 3), shapes (J, 3, 3), bounds (J,) and states (J,) of the joints moved on to `t_s`."""
    joints, count = known.joints.copy(), len(known.joints)
    positions, shape_m2 = np.empty((count, 3)), np.zeros((count, 3, 3))
    bound_m, states = np.empty(count), np.empty(count, np.uint8)
    for j in range(count):
        gated_filter.predict(joints[j], from_s, t_s, biased_filter.density(joints[j], t_s))
        motion_set.move(joints[j], t_s - from_s)
        biased_filter.settle(joints[j], t_s - from_s)
        for k in range(3):
            positions[j, k] = joints[j].position[k] + joints[j].glide_m[k]
        states[j] = state_of(joints[j].seen_s, t_s)
    build.keep(known.bones[0], joints, positions)
    for j in range(count):
        glide_m = length((joints[j].glide_m[0], joints[j].glide_m[1], joints[j].glide_m[2]))
        words = known.words[j]
        believed_s, sensors = trust.last_believed_s(words), trust.believed_lately(words, t_s)
        radius_m = glide_m + ball.radius_m(joints[j], believed_s, sensors, t_s)
        bound_m[j] = _tell_set(joints[j], radius_m, positions[j], shape_m2[j])
    build.cap(known.bones[0], positions, bound_m, shape_m2)
    return positions, shape_m2, bound_m, states


@kernel
def _tell_set(joint: Record, radius_m: float, point: Floats, shape_m2: Floats) -> float:
    """Put the point into the set, write the ball or the ellipsoid around the set's box; the farthest point of both.

    NaN and infinite for a joint never seen.
    """
    for k in range(3):
        low, high = motion_set.extent(joint, k)
        point[k] = min(max(point[k], low), high)
        shape_m2[k, k] = max(high - point[k], point[k] - low)
    corner_m = length((shape_m2[0, 0], shape_m2[1, 1], shape_m2[2, 2]))
    for k in range(3):
        shape_m2[k, k] = radius_m**2 if radius_m < corner_m else 3 * shape_m2[k, k] ** 2
    if not isfinite(joint.seen_s):
        point[:] = shape_m2[:] = np.nan
        return np.inf
    return min(corner_m, radius_m)
