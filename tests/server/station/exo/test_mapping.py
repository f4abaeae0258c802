"""From a mirror target to the exoskeleton's joints, and the cone near hanging."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fusion.kinematics.angles import direction_from_swing
from fusion.messages import MirrorTarget
from fusion.skeleton import Side
from server.station.exo.mapping import CONE_RAD, JointTarget, cone_freedom, joint_target

COMMANDED = (0.75, 0.5, 0.1, 0.8)


def mirror_target(
    plane: float = 0.8,
    elevation: float = 0.9,
    *,
    bound: float = 0.1,
    twist: float = 0.2,
    valid: bool = True,
) -> MirrorTarget:
    return MirrorTarget(
        t_s=0.0,
        side=Side.LEFT,
        direction_in_limb=direction_from_swing(plane, elevation),
        twist_rad=twist,
        elbow_rad=1.1,
        direction_velocity=np.zeros(3),
        twist_rad_s=0.3,
        elbow_rad_s=-0.4,
        swing_bound_rad=bound,
        twist_bound_rad=2 * bound,
        elbow_bound_rad=bound,
        valid=valid,
    )


def _mapped(target: MirrorTarget) -> JointTarget:
    mapped = joint_target(target, COMMANDED)
    assert mapped is not None
    return mapped


@settings(max_examples=200, derandomize=True, deadline=None)
@given(st.floats(COMMANDED[0] - 3.0, COMMANDED[0] + 3.0), st.floats(CONE_RAD[1], 3.0))
def test_the_joints_point_the_arm_where_the_target_does(plane: float, elevation: float) -> None:
    mapped = _mapped(mirror_target(plane, elevation))
    assert mapped.angle_rad == pytest.approx((plane, elevation, 0.2, 1.1), abs=1e-9)
    assert mapped.bound_rad == (0.1, 0.1, 0.2, 0.1)


def test_inside_the_cone_the_plane_stays_where_it_is_commanded() -> None:
    for plane in (-3.0, 0.0, 2.0):
        mapped = joint_target(mirror_target(plane, CONE_RAD[0] / 2), COMMANDED)
        assert mapped is not None
        assert mapped.angle_rad[0] == COMMANDED[0]
        assert mapped.freedom[0] == 0.0


def test_leaving_the_cone_the_plane_is_freed_steadily() -> None:
    freedoms = [cone_freedom(elevation) for elevation in np.linspace(0, 0.6, 61)]
    assert freedoms[0] == 0.0
    assert freedoms[-1] == 1.0
    assert all(0 <= b - a < 0.06 for a, b in pairwise(freedoms))


def test_the_plane_does_not_jump_where_the_angle_wraps() -> None:
    just_before, just_after = (_mapped(mirror_target(plane)).angle_rad[0] for plane in (pi - 0.01, -pi + 0.01))
    assert just_after - just_before == pytest.approx(0.02)


@pytest.mark.parametrize("joint", [0, 2])
def test_a_target_behind_the_range_that_passes_pi_stays_on_its_side(joint: int) -> None:
    at_the_end = tuple(1.6 if i == joint else angle for i, angle in enumerate(COMMANDED))
    for beyond in (3.1, pi, -3.1):
        astray = mirror_target(plane=beyond) if joint == 0 else mirror_target(twist=beyond)
        mapped = joint_target(astray, at_the_end)
        assert mapped is not None
        assert mapped.angle_rad[joint] > 1.6


def test_without_a_valid_target_there_is_nothing_to_follow() -> None:
    assert joint_target(None, COMMANDED) is None
    assert joint_target(mirror_target(valid=False), COMMANDED) is None


@pytest.mark.parametrize("wrong", [float("nan"), float("inf")])
def test_sr2_a_target_that_is_not_a_number_is_no_target(wrong: float) -> None:
    astray = replace(mirror_target(), direction_in_limb=np.array([wrong, 0.0, 0.0]))
    assert joint_target(astray, COMMANDED) is None
    assert joint_target(mirror_target(twist=wrong), COMMANDED) is None
    assert joint_target(mirror_target(bound=float("nan")), COMMANDED) is None
