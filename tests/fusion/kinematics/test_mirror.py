"""The mirror: an identity when done twice, honest about what it does not know, calm."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fusion.kinematics.angles import direction_from_swing, wrapped
from fusion.kinematics.mirror import TWIST_RATE_RAD_S, mirror
from fusion.messages import JointAngles, MirrorTarget
from fusion.skeleton import Side


def angles(
    t_s: float = 0.0,
    plane: float = 0.5,
    elevation: float = 1.0,
    twist: float = 0.3,
    elbow: float = 1.2,
    side: Side = Side.LEFT,
) -> JointAngles:
    return JointAngles(
        t_s=t_s,
        side=side,
        plane_of_elevation_rad=plane,
        elevation_rad=elevation,
        axial_rotation_rad=wrapped(twist - plane),
        elbow_flexion_rad=elbow,
        alpha_rad=pi - elevation,
        beta_rad=0.0,
        gamma_rad=elbow,
        direction_in_limb=direction_from_swing(plane, elevation),
        twist_rad=twist,
        swing_bound_rad=0.1,
        twist_bound_rad=0.2,
        elbow_bound_rad=0.3,
        valid=True,
    )


def as_seen(target: MirrorTarget, like: JointAngles) -> JointAngles:
    return replace(
        like,
        side=target.side,
        direction_in_limb=target.direction_in_limb,
        twist_rad=target.twist_rad,
        elbow_flexion_rad=target.elbow_rad,
    )


@given(plane=st.floats(-3, 3), elevation=st.floats(0, 3), twist=st.floats(-3, 3), elbow=st.floats(0.8, 2.3))
@pytest.mark.parametrize("side", list(Side))
def test_mirroring_twice_is_the_identity(
    side: Side, plane: float, elevation: float, twist: float, elbow: float
) -> None:
    healthy = angles(plane=plane, elevation=elevation, twist=twist, elbow=elbow, side=side)
    once = mirror(healthy, None)
    twice = mirror(as_seen(once, healthy), None)
    assert once.side is side.other
    assert twice.side is side
    np.testing.assert_array_equal(twice.direction_in_limb, healthy.direction_in_limb)
    assert twice.twist_rad == pytest.approx(twist)
    assert twice.elbow_rad == elbow


def test_bounds_travel_with_the_target() -> None:
    target = mirror(angles(), None)
    assert (target.swing_bound_rad, target.twist_bound_rad, target.elbow_bound_rad) == (0.1, 0.2, 0.3)


def test_what_the_twist_still_has_to_go_is_added_to_its_bound() -> None:
    before = mirror(angles(twist=0.0), None)
    after = mirror(angles(t_s=0.01, twist=1.0), before)
    assert after.twist_rad < 0.1
    assert after.twist_bound_rad == pytest.approx(0.2 + 1.0 - after.twist_rad)
    assert mirror(angles(t_s=0.02, twist=-3.0), after).twist_bound_rad == pi


def test_an_invalid_arm_leaves_the_target_where_it_was_and_claims_nothing() -> None:
    before = mirror(angles(), None)
    after = mirror(replace(angles(t_s=0.01), elbow_flexion_rad=float("nan"), valid=False), before)
    assert not after.valid
    assert after.elbow_rad == before.elbow_rad
    assert after.elbow_rad_s == 0.0
    assert after.swing_bound_rad == pi
    np.testing.assert_array_equal(after.direction_in_limb, before.direction_in_limb)


def test_an_arm_never_seen_is_a_hanging_arm_that_is_invalid() -> None:
    target = mirror(replace(angles(), valid=False), None)
    assert not target.valid
    assert np.isfinite(target.direction_in_limb).all()


def test_steady_movement_is_seen_as_its_velocity() -> None:
    target = None
    for k in range(60):
        target = mirror(angles(t_s=0.01 * k, elbow=1.0 + 0.005 * k, twist=-0.003 * k), target)
    assert target is not None
    assert target.elbow_rad_s == pytest.approx(0.5, rel=0.01)
    assert target.twist_rad_s == pytest.approx(-0.3, rel=0.01)


def test_the_position_is_never_delayed() -> None:
    before = mirror(angles(), None)
    after = mirror(angles(t_s=0.01, elbow=1.4, elevation=1.3), before)
    assert after.elbow_rad == 1.4
    np.testing.assert_array_equal(after.direction_in_limb, direction_from_swing(0.5, 1.3))


def test_a_straight_elbow_keeps_the_twist_it_had() -> None:
    before = mirror(angles(twist=0.4), None)
    after = mirror(angles(t_s=0.01, twist=-2.5, elbow=0.05), before)
    assert after.twist_rad == pytest.approx(0.4)


def test_the_twist_comes_back_without_a_jump_when_the_elbow_bends() -> None:
    target = mirror(angles(twist=0.0), None)
    before = target.twist_rad
    for k in range(1, 200):
        target = mirror(angles(t_s=0.01 * k, twist=2.0, elbow=min(0.01 * k, 1.5)), target)
        assert abs(target.twist_rad - before) <= TWIST_RATE_RAD_S * 0.01 + 1e-9
        before = target.twist_rad
    assert target.twist_rad == pytest.approx(2.0)


@given(first=st.floats(-3.1, 3.1), then=st.floats(-3.1, 3.1))
def test_the_twist_takes_the_shorter_way_round(first: float, then: float) -> None:
    before = mirror(angles(twist=first), None)
    after = mirror(angles(t_s=0.001, twist=then), before)
    assert abs(wrapped(after.twist_rad - then)) <= abs(wrapped(first - then)) + 1e-9


@given(
    elbow=st.floats(0.0, 3.1),
    twist=st.floats(-3.1, 3.1),
    change=st.tuples(*[st.floats(-0.05, 0.05)] * 2),
    jump=st.floats(-3.1, 3.1),
)
def test_a_small_movement_in_a_tick_is_a_small_movement_of_the_target(
    elbow: float, twist: float, change: tuple[float, float], jump: float
) -> None:
    """Whatever the measured twist does where the elbow is straight."""
    before = mirror(angles(elbow=elbow, twist=twist), None)
    moved = angles(t_s=0.01, elbow=elbow + change[0], elevation=1.0 + change[1], twist=wrapped(twist + jump))
    after = mirror(moved, before)
    assert abs(after.elbow_rad - before.elbow_rad) <= 0.05 + 1e-9
    assert np.linalg.norm(after.direction_in_limb - before.direction_in_limb) <= 0.05 + 1e-9
    assert abs(wrapped(after.twist_rad - before.twist_rad)) <= TWIST_RATE_RAD_S * 0.01 + 1e-9


def test_a_change_of_sides_forgets_the_old_target() -> None:
    left = mirror(angles(twist=1.0), None)
    right = mirror(angles(t_s=0.01, twist=-1.0, side=Side.RIGHT), left)
    assert right.twist_rad == pytest.approx(-1.0)
    assert right.twist_rad_s == 0.0


def test_after_a_gap_the_velocity_starts_at_zero() -> None:
    before = mirror(angles(), None)
    later = mirror(angles(t_s=3.0, elbow=2.0), before)
    assert later.elbow_rad_s == 0.0
