"""Bones are learnt and judged, and a doubt lasts a while."""

from __future__ import annotations

import numpy as np

from fusion.compiled import Records, record
from fusion.estimation import bones, trust
from fusion.estimation.measurement import Flags, Heard, read, sight
from fusion.estimation.trust import STEADY_S
from fusion.messages import AlignedSample
from fusion.skeleton import BONES, JOINT_COUNT, TrackingState

from .scene import ELBOW, FRAME_S, HAND, SHOULDER, WRIST, body_at, both, changed, sample_at

FOREARM = BONES.index(("ElbowRight", "WristRight"))


def heard(tracked: bool = True, wandering: bool = False, hidden: bool = False) -> Heard:
    nowhere = (0.0, 0.0, 0.0)
    return Heard(nowhere, tracked, wandering, hidden, nowhere, spine_seen=True)


class Sensor:
    """What is remembered of one sensor."""

    def __init__(self) -> None:
        self.bones = bones.unknown(JOINT_COUNT)
        self.words: Records = np.zeros(JOINT_COUNT, record(trust.FIELDS))
        self.words["doubted_s"] = self.words["believed_s"] = -np.inf

    def wandering(self, sample: AlignedSample) -> Flags:
        return bones.judge(self.bones.copy(), read(sight(sample, JOINT_COUNT)))

    def believed(self, sample: AlignedSample) -> Flags:
        """(J,) which joints of a sample are believed; learns from it."""
        measured = read(sight(sample, JOINT_COUNT))
        wandering = bones.judge(self.bones, measured)
        return np.array(
            [
                bool(measured.given[j])
                and trust.judge(word, sample.t_s, heard(bool(measured.tracked[j]), bool(wandering[j])))
                for j, word in enumerate(self.words)
            ]
        )


def learnt(samples: list[AlignedSample]) -> Sensor:
    known = Sensor()
    for sample in samples:
        known.believed(sample)
    return known


def of_front(seconds: float) -> list[AlignedSample]:
    return [sample for sample in both(seconds) if sample.sensor == "front"]


def test_a_length_is_learnt_to_a_centimetre_under_two_of_noise() -> None:
    assert abs(learnt(of_front(4.0)).bones["length_m"][FOREARM] - 0.25) < 0.01


def test_a_few_wild_frames_do_not_spoil_a_length() -> None:
    samples = of_front(4.0)
    samples[60:65] = [changed(sample, WRIST, 2.0) for sample in samples[60:65]]
    assert abs(learnt(samples).bones["length_m"][FOREARM] - 0.25) < 0.01


def test_a_length_whose_first_frames_were_wild_is_right_within_seconds() -> None:
    samples = of_front(5.0)
    wild = [changed(sample, WRIST, [0.0, 0.3, 0.3]) for sample in samples[:10]]
    known = learnt([*wild, *samples[10:]])
    assert abs(known.bones["length_m"][FOREARM] - 0.25) < 0.03
    assert not known.wandering(sample_at(5.0)).any()


def test_nothing_is_called_wrong_before_a_length_is_known() -> None:
    known = learnt(of_front(0.5))
    assert not known.wandering(changed(sample_at(0.5), WRIST, 2.0)).any()


def test_what_hangs_on_a_wandering_elbow_is_wandering_too() -> None:
    known = learnt(of_front(2.0))
    wandering = known.wandering(changed(sample_at(2.0), [ELBOW, WRIST, HAND], (0.0, -0.4, 0.0)))
    assert wandering[[ELBOW, WRIST, HAND]].all()
    assert not wandering[SHOULDER]


def test_an_inferred_joint_is_doubted_and_for_a_while_after() -> None:
    known = learnt([*of_front(1.0), changed(sample_at(1.0), WRIST, state=TrackingState.INFERRED)])
    soon = known.believed(sample_at(1.0 + FRAME_S))
    later = known.believed(sample_at(1.0 + STEADY_S + FRAME_S))
    assert not soon[WRIST]
    assert later[WRIST]
    assert soon[ELBOW]


def test_a_joint_that_was_not_tracked_at_all_is_believed_when_it_is_tracked_again() -> None:
    known = learnt([*of_front(1.0), changed(sample_at(1.0), WRIST, np.nan, state=TrackingState.LOST)])
    assert known.believed(sample_at(1.0 + FRAME_S))[WRIST]


def test_the_scene_keeps_its_bones() -> None:
    lengths = [np.linalg.norm(body_at(t)[WRIST] - body_at(t)[ELBOW]) for t in (0.0, 1.0, 2.5)]
    np.testing.assert_allclose(lengths, 0.25)


def test_a_sensor_whose_bones_always_shake_is_not_called_wrong_for_it() -> None:
    """Errors of 50 mm make bones shake by 70; a limit learnt from quieter sensors refused half of what they saw."""
    rng = np.random.default_rng(8)
    samples = [sample_at(k * FRAME_S, "front", 0.09, rng) for k in range(300)]
    known = learnt(samples[:150])
    wrong = [known.wandering(sample)[WRIST] for sample in samples[150:]]
    assert np.mean(wrong) < 0.02
