"""The trunk frame: axes, rigid motion, missing joints."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from fusion.kinematics.body_frame import trunk_frame
from fusion.messages import Floats
from fusion.skeleton import INDEX, JOINT_COUNT

PLACES = {
    "SpineBase": (0, -0.5, 0.0),
    "SpineMid": (0, -0.2, 0.0),
    "SpineShoulder": (0, 0, 0),
    "Neck": (0, 0.1, 0),
    "ShoulderRight": (0.18, 0, 0),
    "ShoulderLeft": (-0.18, 0, 0),
    "HipRight": (0.1, -0.5, 0),
    "HipLeft": (-0.1, -0.5, 0),
}


def body(*missing: str) -> Floats:
    positions = np.full((JOINT_COUNT, 3), np.nan)
    for name, place in PLACES.items():
        if name not in missing:
            positions[INDEX[name]] = place
    return positions


def test_the_axes_are_right_up_and_back() -> None:
    trunk = trunk_frame(body())
    assert trunk is not None
    np.testing.assert_allclose(trunk.rotation_trunk_to_room, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(trunk.origin_in_room, 0, atol=1e-12)


def test_a_person_who_faces_the_sensor_looks_towards_it() -> None:
    # In camera space the sensor looks along +z, so a person facing it looks along -z and their right is at +x... seen
    # from the person; the SDK's x grows to the right of somebody who faces the sensor.
    trunk = trunk_frame(body() + np.array([0, 0, 2.0]))
    assert trunk is not None
    facing = -trunk.rotation_trunk_to_room[:, 2]
    np.testing.assert_allclose(facing, [0, 0, -1], atol=1e-12)


@given(turn=st.tuples(*[st.floats(-3, 3)] * 3), shift=st.tuples(*[st.floats(-3, 3)] * 3))
def test_it_moves_with_the_body(turn: tuple[float, float, float], shift: tuple[float, float, float]) -> None:
    rotation = Rotation.from_rotvec(turn).as_matrix()
    trunk = trunk_frame(body() @ rotation.T + shift)
    assert trunk is not None
    np.testing.assert_allclose(trunk.rotation_trunk_to_room, rotation, atol=1e-9)
    np.testing.assert_allclose(trunk.origin_in_room, shift, atol=1e-9)


@pytest.mark.parametrize("missing", list(PLACES))
def test_any_one_joint_may_be_missing(missing: str) -> None:
    trunk = trunk_frame(body(missing))
    assert trunk is not None
    np.testing.assert_allclose(trunk.rotation_trunk_to_room, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(trunk.origin_in_room, 0, atol=1e-12)


def test_the_hips_stand_in_for_both_shoulders() -> None:
    trunk = trunk_frame(body("ShoulderLeft", "ShoulderRight"))
    assert trunk is not None
    np.testing.assert_allclose(trunk.rotation_trunk_to_room, np.eye(3), atol=1e-12)


@pytest.mark.parametrize(
    "missing",
    [
        tuple(PLACES),
        ("ShoulderLeft", "ShoulderRight", "HipLeft"),
        ("SpineBase", "SpineMid", "HipLeft"),
        ("SpineShoulder", "ShoulderLeft"),
    ],
)
def test_too_few_joints_give_no_frame(missing: tuple[str, ...]) -> None:
    assert trunk_frame(body(*missing)) is None


def test_shoulders_on_the_spine_give_no_frame() -> None:
    positions = body("HipLeft")
    positions[INDEX["ShoulderLeft"]] = positions[INDEX["ShoulderRight"]] = (0, 0.01, 0)
    assert trunk_frame(positions) is None
