"""A hitched shoulder is told from a raised arm, a leaning trunk and the sensors' noise."""

from __future__ import annotations

import numpy as np
import pytest
from hand_cranked import HandCranked

from fusion.messages import PipelineFrame
from fusion.skeleton import Side
from fusion.virtual_patient.anatomy import ArmPose
from fusion.virtual_patient.patient import PoseGoal
from server.messages import CloseSession, Enable
from server.station.shoulder import ShoulderRise

RAISED = PoseGoal(ArmPose(0.9, 1.2, 0.0, 0.5))
HITCHED_M, LEANT_RAD = 0.07, 0.35


@pytest.fixture
def rig() -> HandCranked:
    """Engaged, for as long as it takes to be sure of the body."""
    rig = HandCranked()
    assert rig.open().accepted
    rig.run(4.0)
    assert rig.ask(Enable).accepted, rig.last.blockers
    return rig


def settled_hitch_m(rig: HandCranked) -> float:
    """Mean over half a second, once the patient has done it."""
    rig.run(1.5)
    before = len(rig.ticks)
    rig.run(0.5)
    return float(np.mean([tick.shoulder_hitch_m for tick in rig.ticks[before:]]))


def test_a_shoulder_that_is_drawn_up_is_a_hitch_until_it_is_let_down(rig: HandCranked) -> None:
    assert abs(settled_hitch_m(rig)) < 0.02
    rig.patient.hitch_m = HITCHED_M
    assert settled_hitch_m(rig) == pytest.approx(HITCHED_M, abs=0.025)
    rig.patient.hitch_m = 0.0
    assert abs(settled_hitch_m(rig)) < 0.02


def test_leaning_is_no_hitch(rig: HandCranked) -> None:
    rig.patient.lean_rad = LEANT_RAD
    assert abs(settled_hitch_m(rig)) < 0.025
    assert rig.last.trunk_lean_m > 0.1


def test_raising_the_arm_is_no_hitch_but_hitching_to_raise_it_is(rig: HandCranked) -> None:
    rig.goal = RAISED
    raised_m = settled_hitch_m(rig)
    assert raised_m < 0.02
    rig.patient.hitch_m = HITCHED_M
    assert settled_hitch_m(rig) > raised_m + 0.04


def test_nothing_is_told_before_motion_is_enabled_nor_after_the_session(rig: HandCranked) -> None:
    assert all(tick.shoulder_hitch_m == 0.0 for tick in rig.ticks[:300])
    rig.patient.hitch_m = HITCHED_M
    rig.run(1.0)
    assert rig.last.shoulder_hitch_m > 0.02
    rig.ask(CloseSession)
    rig.run(0.5)
    assert rig.last.shoulder_hitch_m == 0.0


def test_a_frame_without_the_arm_changes_nothing() -> None:
    known = ShoulderRise(height_m=0.53).enabled()
    assert known.heard(PipelineFrame(t_s=0.0, sensors=(), samples=()), Side.RIGHT, 0.01) == known
