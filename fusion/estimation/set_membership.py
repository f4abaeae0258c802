"""The default: a set that holds each joint whatever sensors and limbs do within their bounds, and a point inside it.

The stable form of [Du2016 §2.4], see [methods §5]. Every believed measurement is a box in range, azimuth and elevation
that cuts the set; a bound of ±0.2 m refuses nothing below half a metre, so the point is the mean of a gated filter
that takes only what is believed, or what agrees with it.

All that is known is one record per joint (`JOINT`), one per joint and sensor (`WORD`) and one per bone and sensor.
Kernels change records in place, but only those of copies that they make first: a state once told never changes.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from typing import ClassVar, Final

import numpy as np

from fusion.compiled import Record, Records, kernel, record
from fusion.estimation import ball, bias, bones, gated_filter, motion_set, refusals, trust
from fusion.estimation.estimator import Estimator
from fusion.estimation.evidence import Evidence, weigh
from fusion.estimation.freshness import LOST_AFTER_S, TOO_OLD_S, state_of
from fusion.estimation.gated_filter import GATE_SIGMA
from fusion.estimation.measurement import Heard, Sight, read, sight
from fusion.estimation.vectors import distance, length, plus, row
from fusion.messages import AlignedSample, Floats, FusedFrame, Refusal, States
from fusion.skeleton import JOINT_COUNT

JOINT: Final = record([*gated_filter.FIELDS, *motion_set.FIELDS, *ball.FIELDS])
WORD: Final = record([*trust.FIELDS, *bias.FIELDS])

REASONS: Final = (
    "",
    "bone length changed",
    "in doubt, another sensor is sure",
    f"beyond {GATE_SIGMA:g} sigma",
    "does not meet the set",
)
TAKEN, BONE, DOUBT, GATE, SET = range(len(REASONS))


@dataclass(frozen=True, slots=True)
class SetState:
    """All that the estimator knows at `t_s`, of J joints and K sensors with B bones."""

    t_s: float
    joints: Records  # (J,) of JOINT
    sensors: tuple[str, ...]
    words: Records  # (J, K) of WORD
    bones: Records  # (K, B) of bones.BONE
    latest: refusals.Latest


class SetMembership(Estimator):
    """Gated mean inside a set under bounded error, acceleration and speed.

    Args:
        joints: how many; the bones between them are those of `fusion.skeleton`.
    """

    name: ClassVar[str] = "set-membership"

    def __init__(self, joints: int = JOINT_COUNT) -> None:
        nobody = np.zeros((joints, 0), WORD)
        no_bones = np.tile(bones.unknown(joints), (0, 1))
        self._state = SetState(-np.inf, _unseen(np.zeros(joints, JOINT)), (), nobody, no_bones, ())

    def update(self, sample: AlignedSample) -> tuple[Refusal, ...]:
        """Judge the sample, cut the set with what is believed of it, and move the point."""
        if sample.t_s < self._state.t_s - TOO_OLD_S:
            return ()
        self._state, refused = _updated(_acquainted(self._state, sample), sample)
        return refused

    def frame(self, t_s: float) -> FusedFrame:
        """The filter's mean kept inside the set, and the farthest point of set and ball from it."""
        state = self._state
        told = _tell(state.joints, state.words, state.t_s, float(t_s))
        return FusedFrame(t_s, *told, refusals.fresh(state.latest, t_s))

    def snapshot(self) -> object:
        """The estimator's state."""
        return self._state

    def restore(self, snapshot: object) -> None:
        """Go back to an earlier state."""
        if not isinstance(snapshot, SetState):
            raise TypeError(f"a snapshot of {self.name} is a SetState, not {type(snapshot).__name__}")
        self._state = snapshot


def _acquainted(state: SetState, sample: AlignedSample) -> SetState:
    """The state with room for what is to be learnt of the sample's sensor."""
    if sample.sensor in state.sensors:
        return state
    joints = len(state.joints)
    stranger = np.zeros((joints, 1), WORD)
    stranger["doubted_s"] = stranger["believed_s"] = -np.inf
    stranger["heard_s"] = max(sample.t_s, state.t_s)
    words = np.concatenate([state.words, stranger], axis=1)
    known_bones = np.concatenate([state.bones, bones.unknown(joints)[None]])
    return SetState(state.t_s, state.joints, (*state.sensors, sample.sensor), words, known_bones, state.latest)


def _updated(state: SetState, sample: AlignedSample) -> tuple[SetState, tuple[Refusal, ...]]:
    own, at_s = state.sensors.index(sample.sensor), float(sample.t_s)
    t_s = max(at_s, state.t_s)
    joints, words, known_bones, codes = _take(
        state.joints, state.words, state.bones, own, sight(sample, len(state.joints)), state.t_s, t_s, t_s - at_s
    )
    refused = refusals.refused(sample.sensor, codes, REASONS)
    latest = refusals.remember(state.latest, sample.sensor, at_s, refused)
    return SetState(t_s, joints, state.sensors, words, known_bones, latest), refused


@kernel
def _unseen(joints: Records) -> Records:
    for j in range(len(joints)):
        gated_filter.forget(joints[j])
        motion_set.forget(joints[j])
        joints[j].worst_innovation_m = ball.START_M
    return joints


@kernel
def _take(
    before: Records,
    words_before: Records,
    bones_before: Records,
    own: int,
    seen: Sight,
    from_s: float,
    t_s: float,
    late_s: float,
) -> tuple[Records, Records, Records, refusals.Codes]:
    """Move all joints from `from_s` to `t_s`, take what sensor `own` measured `late_s` before.

    Returns the joints, words and bones after, and what was refused of each joint.
    """
    joints, words, known_bones = before.copy(), words_before.copy(), bones_before.copy()
    measured = read(seen)
    wandering = bones.judge(known_bones[own], measured)
    lens = (seen.lens_in_room[0], seen.lens_in_room[1], seen.lens_in_room[2])
    codes = np.zeros(len(joints), np.uint8)
    for j in range(len(joints)):
        joint = joints[j]
        gated_filter.predict(joint, from_s, t_s)
        motion_set.move(joint, t_s - from_s)
        share = bias.share_of(words[j, own], t_s)
        if not measured.given[j]:
            continue
        heard = Heard(row(measured.positions, j), measured.tracked[j], wandering[j])
        evidence = weigh(heard, lens, seen.rotation_sensor_to_room, joint, words[j], own, t_s, late_s)
        if evidence.outvoted:
            codes[j] = BONE if wandering[j] else DOUBT
            continue
        codes[j] = _use(joint, words[j], own, evidence, share, t_s, t_s - from_s)
    return joints, words, known_bones, codes


@kernel
def _use(joint: Record, words: Records, own: int, evidence: Evidence, share: float, t_s: float, dt: float) -> int:
    """Take one joint's evidence if it fits what was expected; the reason where it does not."""
    near = gated_filter.sigmas_off(joint, evidence.unbiased, evidence.variance) <= GATE_SIGMA
    tried = near or evidence.unchecked
    met = tried and motion_set.take(joint, evidence.position, evidence.half_width)
    insists = gated_filter.insists(joint, met, t_s)
    difference_m = plus(evidence.position, joint.position, -1.0)
    begun = insists or not t_s - joint.seen_s < LOST_AFTER_S
    if evidence.shared and met and near and not begun:
        bias.learn(words, own, difference_m, share)
    if not (met or begun):
        return SET if tried else GATE
    if evidence.believed:
        words[own].believed_s = t_s
    if evidence.believed and not begun:
        ball.learn(joint, distance(evidence.unbiased, joint.position), dt)
    _move_point(joint, evidence, near and not begun, t_s)
    if begun:
        motion_set.begin(joint, evidence.position, evidence.half_width)
    return TAKEN


@kernel
def _move_point(joint: Record, evidence: Evidence, near: bool, t_s: float) -> None:
    """Take what is near; start anew where the joint is begun, or where it was not near and nothing spoke against it."""
    if near:
        gated_filter.correct(joint, evidence.unbiased, evidence.variance, t_s)
    else:
        gated_filter.start(joint, evidence.unbiased, evidence.variance, t_s)


@kernel
def _tell(before: Records, words: Records, from_s: float, t_s: float) -> tuple[Floats, Floats, Floats, States]:
    """Positions (J, 3), shapes (J, 3, 3), bounds (J,) and states (J,) of the joints moved on to `t_s`."""
    joints, count = before.copy(), len(before)
    positions, shape_m2 = np.empty((count, 3)), np.zeros((count, 3, 3))
    bound_m, states = np.empty(count), np.empty(count, np.uint8)
    for j in range(count):
        joint = joints[j]
        gated_filter.predict(joint, from_s, t_s)
        motion_set.move(joint, t_s - from_s)
        radius_m = ball.radius_m(joint, trust.last_believed_s(words[j]), t_s)
        bound_m[j] = _tell_set(joint, radius_m, positions[j], shape_m2[j])
        states[j] = state_of(joint.seen_s, t_s)
    return positions, shape_m2, bound_m, states


@kernel
def _tell_set(joint: Record, radius_m: float, point: Floats, shape_m2: Floats) -> float:
    """Write the point and the ball, or the ellipsoid around the set's box; the farthest point of both from the point.

    NaN and infinite for a joint never seen.
    """
    for k in range(3):
        low, high = motion_set.extent(joint, k)
        point[k] = min(max(joint.position[k], low), high)
        shape_m2[k, k] = max(high - point[k], point[k] - low)
    corner_m = length((shape_m2[0, 0], shape_m2[1, 1], shape_m2[2, 2]))
    for k in range(3):
        shape_m2[k, k] = radius_m**2 if radius_m < corner_m else 3 * shape_m2[k, k] ** 2
    if not isfinite(joint.seen_s):
        point[:] = shape_m2[:] = np.nan
        return np.inf
    return min(corner_m, radius_m)
