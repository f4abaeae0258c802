"""A body that moves, and sensors that see it, for the tests of alignment and pipeline."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fusion.align.track import BodyTrack
from fusion.messages import SkeletonSample
from fusion.skeleton import INDEX, JOINT_COUNT

REST = {
    "SpineBase": (0.0, 0.0, 0.0), "SpineMid": (0.0, 0.3, 0.0), "Neck": (0.0, 0.6, 0.0), "Head": (0.0, 0.75, 0.0),
    "ShoulderLeft": (-0.18, 0.5, 0.02), "ElbowLeft": (-0.22, 0.23, 0.03), "WristLeft": (-0.23, 0.0, -0.06),
    "HandLeft": (-0.23, -0.07, -0.09), "ShoulderRight": (0.18, 0.5, 0.02), "ElbowRight": (0.22, 0.23, 0.03),
    "WristRight": (0.23, 0.0, -0.06), "HandRight": (0.23, -0.07, -0.09), "HipLeft": (-0.08, -0.03, 0.0),
    "KneeLeft": (-0.1, -0.43, -0.03), "AnkleLeft": (-0.11, -0.81, 0.0), "FootLeft": (-0.13, -0.88, -0.12),
    "HipRight": (0.08, -0.03, 0.0), "KneeRight": (0.1, -0.43, -0.03), "AnkleRight": (0.11, -0.81, 0.0),
    "FootRight": (0.13, -0.88, -0.12), "SpineShoulder": (0.0, 0.52, 0.0), "HandTipLeft": (-0.23, -0.14, -0.11),
    "ThumbLeft": (-0.2, -0.09, -0.12), "HandTipRight": (0.23, -0.14, -0.11), "ThumbRight": (0.2, -0.09, -0.12),
}  # fmt: skip
"""A person who faces the sensor (towards -z), about the pelvis, metres."""
BODY = np.array([REST[name] for name in INDEX])
RIGHT_ARM = [INDEX[name] for name in ("ElbowRight", "WristRight", "HandRight", "HandTipRight", "ThumbRight")]
LEFT_ARM = [INDEX[name] for name in ("ElbowLeft", "WristLeft", "HandLeft", "HandTipLeft", "ThumbLeft")]


def body_at(t_s, walk_m=0.4):
    """Positions (25, 3) of somebody who sways, turns a little, and raises both arms out of step."""
    positions = BODY.copy()
    for joints, shoulder, phase in ((RIGHT_ARM, "ShoulderRight", 0.0), (LEFT_ARM, "ShoulderLeft", 1.3)):
        swing = Rotation.from_euler("x", 0.9 * (1 - np.cos(1.1 * t_s + phase + 0.6 * np.sin(0.37 * t_s))))
        pivot = positions[INDEX[shoulder]]
        positions[joints] = swing.apply(positions[joints] - pivot) + pivot
    turn = Rotation.from_euler("y", 0.25 * np.sin(0.5 * t_s))
    aside, ahead = walk_m * np.sin(0.43 * t_s), 0.6 * walk_m * np.sin(0.31 * t_s + 1)
    return turn.apply(positions) + np.array([aside, 0.02 * np.sin(1.9 * t_s), 2.4 + ahead])


def seen(rotation, translation, points):
    """Room points as a sensor sees them that stands at `translation`, turned by `rotation` (sensor to room)."""
    return rotation.inv().apply(points.reshape(-1, 3) - translation).reshape(points.shape)


def track(t_s, rotation=None, translation=(0.0, 0.0, 0.0), offset_s=0.0, noise_m=0.0, seed=0, walk_m=0.4):
    """A sensor's track at room instants `t_s`, on its own clock."""
    rotation = rotation or Rotation.identity()
    room = np.array([body_at(t, walk_m) for t in t_s])
    noise = np.random.default_rng(seed).normal(0, noise_m, room.shape)
    positions = seen(rotation, np.asarray(translation), room) + noise
    return BodyTrack(t_s + offset_s, positions, np.full((len(t_s), JOINT_COUNT), 2, dtype=np.uint8))


def samples(sensor, seen_track, body="1", received_after_s=0.0):
    """The track as samples, received a fixed time after they were stamped."""
    return [
        SkeletonSample(sensor, body, t, t + received_after_s, positions, state)
        for t, positions, state in zip(seen_track.t_s.tolist(), seen_track.positions, seen_track.state, strict=True)
    ]


@pytest.fixture(scope="session")
def bodies():
    """The functions above, for tests that cannot import this file."""
    return SimpleNamespace(body_at=body_at, seen=seen, track=track, samples=samples, BODY=BODY)
