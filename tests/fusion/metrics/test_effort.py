"""What the affected arm did itself, on arms whose effort, help and range are known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fusion.messages import Floats
from fusion.metrics.effort import effort_metrics
from fusion.metrics.metric import CARRIED_WEIGHT, ESTIMATED_TORQUE, PASSIVE_DRIVE, Metric
from fusion.metrics.record import DriveTrack, SessionRecord
from fusion.metrics.session import session_metrics
from fusion.skeleton import Side

RATE = 100.0
SECONDS = 60.0
AMPLITUDE_RAD, RHYTHM_RAD_S = 0.5, 1.5


def swaying(own_nm: float = 2.0, drive_nm: float = 6.0, assistance: str = "assisted") -> SessionRecord:
    """An elbow that sways; arm and drive both push along with a steady torque. Engaged throughout."""
    t_s = np.arange(0.0, SECONDS, 1 / RATE)
    speed = np.zeros((len(t_s), 4))
    speed[:, 3] = AMPLITUDE_RAD * RHYTHM_RAD_S * np.cos(RHYTHM_RAD_S * t_s)
    angle = np.full((len(t_s), 4), 1.0)
    angle[:, 3] += AMPLITUDE_RAD * np.sin(RHYTHM_RAD_S * t_s)
    drive = DriveTrack(
        velocity_rad_s=speed,
        torque_nm=drive_nm * np.sign(speed),
        interaction_nm=own_nm * np.sign(speed),
        share=np.full((len(t_s), 4), 0.4),
        assistance=np.full(len(t_s), assistance),
        level=np.full(len(t_s), 0.7),
    )
    return SessionRecord(
        t_s=t_s,
        state=np.full(len(t_s), "engaged"),
        healthy_side=Side.RIGHT,
        healthy_rad=angle,
        healthy_valid=np.ones(len(t_s), dtype=bool),
        affected_rad=angle,
        hand_in_trunk=np.zeros((len(t_s), 3)),
        trunk_displacement_m=np.zeros(len(t_s)),
        sensors=(),
        hits=0,
        misses=0,
        pain_calls=2,
        drive=drive,
    )


def figures(record: SessionRecord) -> dict[tuple[str, str | None], Metric]:
    return {(metric.name, metric.joint): metric for metric in effort_metrics(record)}


def values(record: SessionRecord) -> dict[str, float]:
    return {name: metric.value for (name, joint), metric in figures(record).items() if joint in (None, "elbow")}


def with_drive(record: SessionRecord, **changed: Floats) -> SessionRecord:
    assert record.drive is not None
    return replace(record, drive=replace(record.drive, **changed))


def test_own_effort_is_the_arms_torque_along_the_movement() -> None:
    found = figures(swaying())
    assert found["own_effort", "elbow"].value == pytest.approx(2.0)
    assert found["own_effort_p95", "elbow"].value == pytest.approx(2.0)
    assert found["own_effort", "elbow"].unit == "N m"
    assert found["own_effort", "elbow"].side is Side.LEFT
    assert found["own_effort", "elbow"].caveat_key == ESTIMATED_TORQUE
    assert ("own_effort", "plane") not in found, "a joint that stands still has no direction"


def test_an_arm_that_only_resists_makes_no_effort_of_its_own() -> None:
    found = values(swaying(own_nm=-2.0))
    assert found["own_effort"] == 0.0
    assert found["own_work"] == 0.0
    assert found["own_work_share"] == 0.0


def test_the_work_is_torque_over_the_way() -> None:
    found = values(swaying(own_nm=2.0, drive_nm=6.0))
    way_rad = 4 * AMPLITUDE_RAD * SECONDS * RHYTHM_RAD_S / (2 * np.pi)
    assert found["own_work"] == pytest.approx(2.0 * way_rad, rel=0.01)
    assert found["drive_work"] == pytest.approx(6.0 * way_rad, rel=0.01)
    assert found["own_work_share"] == pytest.approx(0.25)
    assert figures(swaying())["own_work_share", None].caveat_key == CARRIED_WEIGHT


@given(st.floats(0.1, 20.0), st.floats(0.1, 20.0))
def test_the_arms_part_of_the_work_grows_with_its_torque(own_nm: float, drive_nm: float) -> None:
    share = values(swaying(own_nm, drive_nm))["own_work_share"]
    assert share == pytest.approx(own_nm / (own_nm + drive_nm))


def test_nothing_counts_while_the_arm_is_held() -> None:
    held = swaying()
    held = replace(held, state=np.where(held.t_s < SECONDS / 2, "engaged", "hold"))
    assert values(held)["own_work"] == pytest.approx(values(swaying())["own_work"] / 2, rel=0.02)
    assert values(held)["minutes_assisted"] == pytest.approx(0.5, abs=0.01)


def test_help_and_minutes_are_told_by_the_way_of_helping() -> None:
    found = values(swaying())
    assert found["help"] == pytest.approx(0.4)
    assert found["help_allowed"] == pytest.approx(0.7)
    assert found["minutes_assisted"] == pytest.approx(1.0, abs=0.01)
    assert not {"minutes_passive", "minutes_free"} & found.keys()
    assert "help_allowed" not in values(swaying(assistance="passive"))


def test_own_range_is_what_the_arm_reached_unaided() -> None:
    found = values(swaying(assistance="free"))
    assert found["own_range"] == pytest.approx(2 * AMPLITUDE_RAD, rel=0.02)
    assert found["own_range_lowest"] == pytest.approx(1.0 - AMPLITUDE_RAD, abs=0.02)
    assert "own_range" not in values(swaying(assistance="assisted"))


def test_soft_holds_are_counted_and_one_that_becomes_firm_is_none() -> None:
    record = swaying()
    state = np.full(len(record.t_s), "engaged")
    share = np.full((len(record.t_s), 4), 1.0)
    state[1000:1400], share[1000:1400] = "hold", 0.2  # soft for 4 s
    state[2000:2400], share[2000:2025] = "hold", 0.2  # firm after a quarter of a second
    state[5900:], share[5900:] = "hold", 0.2  # soft to the end
    assert values(with_drive(replace(record, state=state), share=share))["soft_holds"] == 2


def test_pain_calls_are_told() -> None:
    assert values(swaying())["pain_calls"] == 2


def test_recordings_that_do_not_tell_have_no_such_figures_rather_than_zero() -> None:
    assert effort_metrics(replace(swaying(), drive=None)) == []
    blind = values(with_drive(swaying(), interaction_nm=np.zeros((int(SECONDS * RATE), 4))))
    assert not {"own_effort", "own_work", "drive_work", "own_work_share"} & blind.keys()
    assert "help" in blind


@pytest.mark.parametrize(("assistance", "caveat"), [("passive", PASSIVE_DRIVE), ("assisted", None), ("free", None)])
def test_the_affected_arms_range_is_the_drives_only_where_the_drive_moved_it(
    assistance: str, caveat: str | None
) -> None:
    found = session_metrics(swaying(assistance=assistance))
    (metric,) = [m for m in found if m.name == "range_of_movement" and m.joint == "elbow" and m.side is Side.LEFT]
    assert metric.caveat_key == caveat
