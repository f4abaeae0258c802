"""A spastic arm in the simulated exoskeleton, through the whole loop: the catch is given way to at once (SR-18)."""

from __future__ import annotations

import pytest
from hand_cranked import HandCranked

from fusion.virtual_patient.anatomy import ArmPose
from fusion.virtual_patient.patient import PoseGoal
from server.messages import DriveState, Enable
from server.station.exo.simulated_arm.person import Spasticity

BENT = PoseGoal(ArmPose(plane_rad=1.0, elevation_rad=0.8, rotation_rad=0.2, elbow_rad=2.0))
STRAIGHT = PoseGoal(ArmPose(plane_rad=1.0, elevation_rad=0.8, rotation_rad=0.2, elbow_rad=0.3))


def straightened(spasticity: Spasticity | None) -> HandCranked:
    """The healthy elbow goes from bent to straight, and the exoskeleton with it, for four seconds."""
    rig = HandCranked(spasticity=spasticity)
    assert rig.open().accepted
    rig.goal = BENT
    rig.run(4.0)
    assert rig.ask(Enable).accepted, rig.last.blockers
    rig.run(4.0)
    rig.goal = STRAIGHT
    rig.run(4.0)
    return rig


@pytest.fixture(scope="module")
def spastic() -> HandCranked:
    return straightened(Spasticity())


def _held(rig: HandCranked) -> int:
    return next(k for k, tick in enumerate(rig.ticks) if tick.state is DriveState.HOLD)


def test_sr18_a_spastic_catch_of_the_simulated_arm_makes_the_hold_compliant_at_once(spastic: HandCranked) -> None:
    held = _held(spastic)
    caught = next(k for k, tick in enumerate(spastic.ticks) if abs(tick.exo.interaction_nm[3]) > 6.0)
    assert 0 <= held - caught <= 3
    assert "elbow resists" in spastic.ticks[held].reason
    assert all(tick.exo.compliant for tick in spastic.ticks[held:])


def test_sr18_a_caught_elbow_may_bend_and_comes_to_rest_where_it_resisted(spastic: HandCranked) -> None:
    elbow = [tick.exo.angle_rad[3] for tick in spastic.ticks[_held(spastic) :]]
    assert spastic.last.state is DriveState.HOLD
    assert max(elbow) > elbow[0] + 0.1
    assert min(elbow) > elbow[0] - 0.1
    assert elbow[-1] == pytest.approx(elbow[0], abs=0.15)
    assert abs(spastic.last.exo.velocity_rad_s[3]) < 0.05
    assert abs(spastic.last.exo.interaction_nm[3]) < 6.0


def test_sr18_a_calm_arm_is_straightened_without_a_hold() -> None:
    calm = straightened(None)
    assert calm.last.state is DriveState.ENGAGED
    assert calm.last.exo.angle_rad[3] < 0.7
