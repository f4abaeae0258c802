"""The studies of the safety gate, made small; and the judge finds what is outside."""

from __future__ import annotations

from dataclasses import replace
from random import Random

import pytest

from fusion.experiments.experiment import Setup
from server.experiments.catalogue import assistance, commands, fault_sequences
from server.experiments.gate import wild
from server.experiments.gate.faults import FAULTS, Fault
from server.experiments.gate.judge import excursions
from server.experiments.gate.plant import QuickArm
from server.experiments.gate.rig import GateRig, middle
from server.messages import DriveState, Enable
from server.station.exo.limiter import Motion
from server.station.exo.softness import device_of

EFFORT = 0.006
ELBOW = 3
MIDDLE = middle(wild.STATION.device)


def engaged() -> GateRig:
    """A patient who may move as far as the device, past the blend-in."""
    rig = GateRig(wild.STATION.device, device_of(wild.STATION.exoskeleton, can_comply=True), QuickArm(MIDDLE))
    rig.tick(wild.near_target(MIDDLE))
    assert rig.wish(Enable(number=1))
    for _ in range(220):
        rig.tick(wild.near_target(MIDDLE))
    return rig


def test_sr1_sr2_no_wild_command_takes_joint_or_command_out_of_its_limits() -> None:
    outcome = commands.run(Setup(seed=5, effort=EFFORT))
    assert outcome.beside[0].met, outcome.tables[0].rows
    assert outcome.seeds == (5,)


def test_sr8_after_random_faults_the_gate_is_safe_in_time_and_nothing_leaves_its_limits() -> None:
    outcome = fault_sequences.run(Setup(seed=5, effort=EFFORT))
    assert all(row.met for row in outcome.beside), outcome.tables


def test_help_rises_where_the_simulated_arm_is_kept_back_and_fades_after_it() -> None:
    outcome = assistance.run(Setup(effort=0.3))
    assert outcome.beside[0].met, outcome.tables[0].rows
    assert all(row[-1] == "yes" for row in outcome.tables[0].rows)


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault.name)
def test_sr8_every_fault_of_the_study_is_one_that_the_gate_must_act_on(fault: Fault) -> None:
    rig = engaged()
    tally, reaching = fault_sequences.Tally(), fault_sequences.Reaching.of(Random(1), rig)
    for _ in range(50):
        rig.tick(reaching.at(rig.t_s))
    fault_sequences.one_fault(Random(1), rig, reaching, fault, tally)
    (watch,) = tally.watched[fault.name]
    assert watch.engaged
    assert watch.to_safe_s is not None
    assert watch.to_safe_s <= fault.within_s
    assert rig.now is not DriveState.ENGAGED


@pytest.mark.parametrize(
    ("motion", "found"),
    [
        (Motion(MIDDLE[ELBOW] + 0.1), "step"),
        (Motion(9.0), "range"),
        (Motion(MIDDLE[ELBOW], 3.0), "velocity"),
        (Motion(MIDDLE[ELBOW], 0.0, 11.0), "acceleration"),
        (Motion(MIDDLE[ELBOW], 0.0, 9.0), "jerk"),
    ],
)
def test_the_judge_finds_a_set_point_that_breaks_a_limit(motion: Motion, found: str) -> None:
    rig = engaged()
    assert excursions(rig) == []
    rig.state = replace(rig.state, motions=(*rig.state.motions[:ELBOW], motion))
    assert f"command: {found}" in excursions(rig)


def test_the_judge_finds_a_joint_outside_its_range_and_what_is_no_number() -> None:
    rig = engaged()
    rig.arm._moving[0, ELBOW] = rig.limits[ELBOW].max_rad + 0.01
    assert excursions(rig) == ["joint: outside its range"]
    assert excursions(rig, tolerance_rad=0.02) == []
    rig.command = replace(rig.command, angle_rad=(float("nan"),) * 4)
    assert excursions(rig) == ["command: not a number"]
