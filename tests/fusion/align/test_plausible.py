"""Senders that cannot be right are found out, and right ones are not suspected."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fusion.align.plausible import EXCHANGED, MIRROR, MIRROR_IMAGE, MIRRORED, feet_fault, handedness_fault, unit_fault
from fusion.align.track import pair
from fusion.skeleton import SIDES_SWAPPED

TIMES = np.arange(0.0, 8.0, 1 / 30)
TURN, PLACE = Rotation.from_euler("y", 1.5), (2.3, 0.0, 2.2)


def exchanged(track):
    return replace(track, positions=track.positions[:, SIDES_SWAPPED])


def mirrored(track):
    return replace(track, positions=track.positions * MIRROR)


@pytest.mark.parametrize(
    ("spoil", "fault"),
    [
        (lambda track: track, None),
        (exchanged, EXCHANGED),
        (mirrored, MIRRORED),
        (lambda track: exchanged(mirrored(track)), MIRROR_IMAGE),
    ],
)
def test_handedness_is_told_against_the_other_sensor(bodies, spoil, fault):
    reference = bodies.track(TIMES, noise_m=0.02, seed=1)
    sensor = spoil(bodies.track(TIMES, TURN, PLACE, noise_m=0.02, seed=2))
    assert handedness_fault(pair(reference, sensor, 0.0, 45)) is fault


@pytest.mark.parametrize("spoil", [exchanged, mirrored])
def test_backward_feet_give_a_mirrored_sender_away_without_another_sensor(bodies, spoil):
    seen = bodies.track(TIMES, noise_m=0.02)
    assert feet_fault(seen) is None
    assert feet_fault(spoil(seen)) is not None


@pytest.mark.parametrize(("factor", "word"), [(1000.0, "millimetres"), (100.0, "centimetres"), (3.281, "feet")])
def test_a_wrong_unit_is_named(bodies, factor, word):
    seen = bodies.track(TIMES)
    fault = unit_fault(seen.positions * factor, seen.state)
    assert fault is not None
    assert word in fault.what
    assert "metres" in fault.remedy


@pytest.mark.parametrize("height", [0.55, 0.8, 1.0, 1.25])
def test_children_and_tall_people_are_people(bodies, height):
    seen = bodies.track(TIMES)
    assert unit_fault(seen.positions * height, seen.state) is None
