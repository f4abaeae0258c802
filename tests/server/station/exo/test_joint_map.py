"""The joint map: there and back, and equal power on both sides."""

from __future__ import annotations

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.exoskeleton import BUILT_IN, device_limits
from server.station.exo.joint_map import JointMap

FOUR = st.tuples(*[st.floats(-2, 2)] * 4)
TURNED = msgspec.structs.replace(
    BUILT_IN,
    joints=tuple(
        msgspec.structs.replace(joint, sign=-1 if index % 2 else 1, offset_rad=0.1 * index)
        for index, joint in enumerate(BUILT_IN.joints)
    ),
)
MAP = JointMap(TURNED)


@given(FOUR)
def test_angles_and_velocities_come_back(values: tuple[float, ...]) -> None:
    assert MAP.anatomical_rad(MAP.joints_rad(values)) == pytest.approx(values, abs=1e-9)
    assert MAP.anatomical_rad_s(MAP.joints_rad_s(values)) == pytest.approx(values, abs=1e-9)


@given(FOUR, FOUR)
def test_power_is_the_same_on_both_sides(torque: tuple[float, ...], velocity: tuple[float, ...]) -> None:
    joints_nm = MAP.joints_nm(torque)
    assert MAP.anatomical_nm(joints_nm) == pytest.approx(torque, abs=1e-9)
    assert joints_nm @ MAP.joints_rad_s(velocity) == pytest.approx(np.dot(torque, velocity), abs=1e-9)


@given(st.tuples(*[st.floats(0, 1)] * 4))
def test_sr1_angles_inside_the_devices_limits_keep_every_joint_inside_its_own(share: tuple[float, ...]) -> None:
    angles = [
        low.min_rad + s * (low.max_rad - low.min_rad) for low, s in zip(device_limits(TURNED), share, strict=True)
    ]
    for angle, joint in zip(MAP.joints_rad(angles), TURNED.joints, strict=True):
        assert joint.min_rad - 1e-9 <= angle <= joint.max_rad + 1e-9


def test_a_share_goes_to_the_joint_that_follows_its_angle() -> None:
    assert MAP.spread((0.1, 0.2, 0.3, 0.4), resting=1.0).tolist() == [0.1, 0.2, 0.3, 0.4, 1.0, 1.0, 1.0]


@given(st.tuples(*[st.floats(-2, 2)] * 4), st.tuples(*[st.floats(0, 1)] * 4), st.tuples(*[st.floats(0, 1)] * 4))
def test_sr1_the_joints_ranges_hold_every_arm_inside_the_given_ends(
    low: tuple[float, ...], wide: tuple[float, ...], share: tuple[float, ...]
) -> None:
    ends = tuple((start, start + width) for start, width in zip(low, wide, strict=True))
    ranges = MAP.ranges_rad(ends)
    joints = MAP.joints_rad([a + s * (b - a) for (a, b), s in zip(ends, share, strict=True)])
    assert (joints >= ranges[:, 0] - 1e-9).all()
    assert (joints <= ranges[:, 1] + 1e-9).all()


def test_a_joint_that_follows_one_angle_has_exactly_its_range() -> None:
    elbow = TURNED.joints[3]
    low, high = MAP.ranges_rad(((0, 1), (0, 1), (0, 1), (0.2, 1.0)))[3]
    assert sorted(elbow.sign * (end - elbow.offset_rad) for end in (low, high)) == pytest.approx([0.2, 1.0])
