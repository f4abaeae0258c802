"""A joint's angles and torques against its motor's."""

from __future__ import annotations

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.exoskeleton import BUILT_IN
from server.station.exo.cia402.units import Units

JOINT = msgspec.structs.replace(BUILT_IN.joints[0], gear_ratio=100.0, counts_per_turn=4096)
UNITS = Units.of(JOINT, rated_motor_nm=0.5)


def test_a_turn_of_the_joint_is_the_gears_turns_of_the_motor() -> None:
    assert UNITS.counts(2 * 3.141592653589793) == 100 * 4096
    assert UNITS.rpm(2 * 3.141592653589793) == 6000


def test_the_rated_torque_is_a_thousand_at_the_motor_and_the_gears_multiple_at_the_joint() -> None:
    assert UNITS.nm(1000) == pytest.approx(50.0)
    assert UNITS.per_mille(25.0) == 500


@given(st.floats(-7, 7))
def test_an_angle_comes_back_within_half_a_count(angle_rad: float) -> None:
    assert abs(UNITS.rad(UNITS.counts(angle_rad)) - angle_rad) <= 0.5001 / UNITS.counts_per_rad


@given(st.floats(-100, 100))
def test_a_torque_comes_back_within_half_a_thousandth(torque_nm: float) -> None:
    assert abs(UNITS.nm(UNITS.per_mille(torque_nm)) - torque_nm) <= 0.5001 * UNITS.rated_nm / 1000
