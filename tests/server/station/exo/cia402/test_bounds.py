"""A patient's limits become the drives' own."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from server.config import StationConfig
from server.exoskeleton import BUILT_IN, Follows
from server.messages import JointLimits
from server.station.exo.cia402.bounds import device_bounds, patient_bounds
from server.station.exo.joint_map import JointMap

DEVICE = StationConfig().device
shares = st.tuples(*[st.tuples(st.floats(0, 0.45), st.floats(0.55, 1)) for _ in DEVICE])
places = st.tuples(*[st.floats(0, 1) for _ in DEVICE])


def _limits(share: tuple[tuple[float, float], ...]) -> tuple[JointLimits, ...]:
    return tuple(
        JointLimits(
            joint=own.joint,
            min_rad=own.min_rad + low * (own.max_rad - own.min_rad),
            max_rad=own.min_rad + high * (own.max_rad - own.min_rad),
            velocity_rad_s=0.5,
            acceleration_rad_s2=2.0,
        )
        for own, (low, high) in zip(DEVICE, share, strict=True)
    )


@given(shares, places)
def test_sr1_every_pose_that_a_patient_is_allowed_lies_inside_every_drives_range(
    share: tuple[tuple[float, float], ...], place: tuple[float, ...]
) -> None:
    limits = _limits(share)
    pose = [each.min_rad + at * (each.max_rad - each.min_rad) for each, at in zip(limits, place, strict=True)]
    bounds = patient_bounds(BUILT_IN, limits)
    for joint, allowed, angle in zip(BUILT_IN.joints, bounds, JointMap(BUILT_IN).joints_rad(pose), strict=True):
        inside = min(max(angle, joint.min_rad), joint.max_rad)
        assert allowed.min_rad - 1e-9 <= inside <= allowed.max_rad + 1e-9


@given(shares)
def test_sr1_no_drive_gets_more_than_the_device_allows(share: tuple[tuple[float, float], ...]) -> None:
    for joint, allowed in zip(BUILT_IN.joints, patient_bounds(BUILT_IN, _limits(share)), strict=True):
        own = device_bounds(joint)
        assert own.min_rad <= allowed.min_rad <= allowed.max_rad <= own.max_rad
        assert allowed.velocity_rad_s <= own.velocity_rad_s
        assert allowed.acceleration_rad_s2 <= own.acceleration_rad_s2


def test_a_joint_that_follows_two_angles_may_move_as_fast_as_both() -> None:
    bounds = patient_bounds(BUILT_IN, _limits(((0.0, 1.0),) * 4))
    axial = [joint.follows for joint in BUILT_IN.joints].index(Follows.AXIAL_ROTATION)
    assert np.isclose(bounds[axial].velocity_rad_s, 1.0)


def test_sr1_a_joint_that_rests_keeps_the_devices_range() -> None:
    bounds = patient_bounds(BUILT_IN, _limits(((0.2, 0.8),) * 4))
    resting = [i for i, joint in enumerate(BUILT_IN.joints) if joint.follows is Follows.NONE]
    assert all(bounds[i] == device_bounds(BUILT_IN.joints[i]) for i in resting)
