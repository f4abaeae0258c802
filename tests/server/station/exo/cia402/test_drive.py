"""The drive on its bus: powered, moved, watched, stopped, reset, closed."""

from __future__ import annotations

import struct
import time
from math import cos

import pytest
from cia402_bench import HEARTBEAT_S, Bench, emulated, fault_of, follow, four_joints, listening, powered, tick

from server.messages import EXO_JOINTS, JointLimits
from server.station.exo.cia402 import Cia402Drive


def _swing(start: tuple[float, ...]) -> object:
    """A smooth movement of a tenth of a radian each way, from where the joints stand."""
    return lambda _reading, t_s: follow(tuple(angle + 0.1 * (1 - cos(2 * t_s)) for angle in start))


def _limits(bench: Bench, room_rad: float = 0.4) -> tuple[JointLimits, ...]:
    """A range about where the arm lies."""
    return tuple(
        JointLimits(
            joint=joint, min_rad=at - room_rad, max_rad=at + room_rad, velocity_rad_s=1.0, acceleration_rad_s2=5.0
        )
        for joint, at in zip(EXO_JOINTS, (0.9, 0.4, 0.2, 1.0), strict=True)
    )


def test_every_drive_comes_into_operation_and_holds_where_it_stood(bench: Bench) -> None:
    before = bench.angles()
    with Cia402Drive(bench.exoskeleton) as drive:
        reading = powered(drive, bench)
        assert reading.fault == ""
        assert reading.angle_rad == pytest.approx((0.9, 0.4, 0.2, 1.0), abs=1e-3)
        tick(drive, 0.2)
        assert bench.angles() == pytest.approx(before, abs=1e-3)


def test_a_movement_at_100_hz_is_followed(bench: Bench) -> None:
    with Cia402Drive(bench.exoskeleton) as drive:
        start = powered(drive, bench).angle_rad
        readings = tick(drive, 1.6, _swing(start))
        assert not readings[-1].fault
        moved = [reading.angle_rad[3] - start[3] for reading in readings]
        assert max(moved) == pytest.approx(0.2, abs=0.02)
        tick(drive, 0.3, lambda *_: follow(start))
        assert tick(drive, 0.02)[-1].angle_rad == pytest.approx(start, abs=0.02)


def test_each_cycle_is_a_set_point_per_drive_then_the_sync_then_the_heartbeat(bench: Bench) -> None:
    with Cia402Drive(bench.exoskeleton) as drive:
        start = powered(drive, bench).angle_rad
        with listening(bench.exoskeleton.cia402.channel) as heard:
            tick(drive, 0.05, lambda *_: follow(start))
        sent = [
            message for message in heard if message.arbitration_id < 0x80 + 1 or _of_station(message.arbitration_id)
        ]
    cycle = [message.arbitration_id for message in sent[:6]]
    assert cycle == [0x201, 0x202, 0x203, 0x204, 0x80, 0x77F]
    control, target, torque = struct.unpack("<HiH", sent[0].data)
    assert (control, torque) == (0x0F, 500)  # operation enabled; 40 N m of 0.8 N m rated times 100
    assert target == pytest.approx(0.9 * 65536 * 100 / 6.283185, abs=2000)
    measured = [message for message in heard if message.arbitration_id == 0x181]
    assert struct.unpack("<Hih", measured[0].data)[0] & 0x6F == 0x27


def _of_station(identifier: int) -> bool:
    return identifier in (0x80, 0x77F) or 0x200 <= identifier < 0x280


def test_sr1_the_patients_range_is_kept_by_the_drives_themselves(bench: Bench) -> None:
    with Cia402Drive(bench.exoskeleton) as drive:
        powered(drive, bench)
        drive.fit(_limits(bench, 0.1))
        tick(drive, 0.5)
        beyond = follow((1.15, 0.65, 0.45, 1.25))
        readings = tick(drive, 1.7, lambda *_: beyond)
        assert readings[-1].fault == ""
        # 0.25 rad were asked for, and each drive stopped at its own limit of 0.1.
        assert readings[-1].angle_rad[0] == pytest.approx(1.0, abs=0.01)
        assert readings[-1].angle_rad[3] == pytest.approx(1.1, abs=0.01)


def test_sr1_a_drive_that_does_not_take_the_patients_range_is_a_fault(bench: Bench) -> None:
    with Cia402Drive(bench.exoskeleton) as drive:
        powered(drive, bench)
        bench.order("refuse-limits elbow")
        drive.fit(_limits(bench))
        said = fault_of(drive)
        assert "'elbow'" in said
        assert "607Dh" in said
        bench.order("refuse-limits elbow 0")
        drive.reset()
        assert powered(drive, bench).fault == ""


def test_sr1_a_range_that_the_arm_is_outside_of_is_refused_and_nothing_moves(bench: Bench) -> None:
    with Cia402Drive(bench.exoskeleton) as drive:
        powered(drive, bench)
        before = bench.angles()
        bench_limits = _limits(bench)
        away = JointLimits(joint="elbow", min_rad=1.5, max_rad=2.0, velocity_rad_s=1.0, acceleration_rad_s2=5.0)
        drive.fit((*bench_limits[:3], away))
        said = fault_of(drive)
        assert "'elbow'" in said
        assert "the patient's range" in said
        assert bench.angles() == pytest.approx(before, abs=2e-3)


@pytest.mark.parametrize(
    ("order", "said"),
    [
        ("fault elbow 0x7121", "the motor is blocked"),
        ("fault elbow 0x3210", "supply voltage is too high"),
        ("fault elbow 0xFF17", "an error of its maker's own (error FF17h)"),
        ("silent elbow", "(node 4)"),
        ("no-heartbeat elbow", "is silent: no heartbeat"),
        ("no-measurement elbow", "no longer says where it stands"),
        ("restart elbow", "restarted"),
    ],
)
def test_sr8_what_is_wrong_with_one_drive_is_said_and_stops_all(bench: Bench, order: str, said: str) -> None:
    with Cia402Drive(bench.exoskeleton) as drive:
        powered(drive, bench)
        bench.order(order)
        fault = fault_of(drive)
        assert "'elbow'" in fault
        assert said in fault
        tick(drive, 0.2)
        others = {node.drive.state.value for name, node in bench.nodes.items() if name != "elbow"}
        assert others == {"quick stop active"}


def test_sr8_a_blocked_joint_is_found_by_its_own_drive(bench: Bench) -> None:
    with Cia402Drive(bench.exoskeleton) as drive:
        start = powered(drive, bench).angle_rad
        bench.order("blocked elbow")
        readings = tick(drive, 5.0, lambda *_: follow(tuple(a + 0.6 for a in start)), lambda r: bool(r.fault))
        assert "'elbow'" in readings[-1].fault
        assert "too far from its set-point" in readings[-1].fault


def test_sr5_a_fault_stays_until_a_person_resets_it_and_then_the_drives_hold_where_they_stand(bench: Bench) -> None:
    with Cia402Drive(bench.exoskeleton) as drive:
        start = powered(drive, bench).angle_rad
        tick(drive, 0.3, _swing(start))
        bench.order("fault elbow 0x4310")
        assert fault_of(drive)
        tick(drive, 0.5, lambda *_: follow(start))
        assert "operation enabled" not in bench.states()
        stood = bench.angles()
        drive.reset()
        assert powered(drive, bench).fault == ""
        tick(drive, 0.3)
        assert bench.angles() == pytest.approx(stood, abs=3e-3)


def test_sr5_a_reset_does_not_help_while_the_drive_is_gone(bench: Bench) -> None:
    with Cia402Drive(bench.exoskeleton) as drive:
        powered(drive, bench)
        bench.order("silent elbow")
        fault_of(drive)
        drive.reset()
        readings = tick(drive, 6.0, until=lambda reading: "'elbow'" in reading.fault)
        assert all(reading.fault for reading in readings)
        assert "'elbow'" in readings[-1].fault


def test_sr3_drives_that_hear_no_station_stop_by_themselves_and_hold(bench: Bench) -> None:
    with Cia402Drive(bench.exoskeleton) as drive:
        start = powered(drive, bench).angle_rad
        tick(drive, 0.8, _swing(start))
        time.sleep(2 * HEARTBEAT_S + 0.5)  # the loop stands still: twice the heartbeat, and the ramp
        assert bench.states() == {"quick stop active"}
        stood = bench.angles()
        time.sleep(0.2)
        assert bench.angles() == pytest.approx(stood, abs=1e-3)
        assert "heard nothing from the station" in fault_of(drive)


def test_sr7_when_it_is_closed_every_drive_holds_powered_and_needs_no_station(bench: Bench) -> None:
    with Cia402Drive(bench.exoskeleton) as drive:
        start = powered(drive, bench).angle_rad
        tick(drive, 0.4, _swing(start))
        bench.order("load all -5")
    stood = bench.angles()
    time.sleep(0.5)
    assert bench.states() == {"quick stop active"}
    assert bench.angles() == pytest.approx(stood, abs=0.02)


def test_sr2_torque_is_bounded_by_what_carries_the_arm_and_what_the_command_allows() -> None:
    with emulated(four_joints(carry_nm={"elbow": 6.0})) as bench, Cia402Drive(bench.exoskeleton) as drive:
        start = powered(drive, bench).angle_rad
        bench.order("load elbow -5")
        soft = lambda *_: follow(start, share=(0.0,) * 4, torque_nm=(3.0,) * 4)  # noqa: E731  # one line
        tick(drive, 0.3, soft)
        assert bench.angles()["elbow"] == pytest.approx(0.2 - 1.0, abs=0.02)  # carried: it does not sink
        bench.order("load elbow -20")
        readings = tick(drive, 0.6, soft)
        assert max(abs(reading.torque_nm[3]) for reading in readings) < 6.2
        assert bench.angles()["elbow"] < -1.0  # it gives way


def test_sr18_torque_beyond_what_weight_can_ask_is_the_arms() -> None:
    carried = {"shoulder plane": 2.0, "shoulder elevation": 2.0, "upper arm rotation": 2.0, "elbow": 2.0}
    with emulated(four_joints(carry_nm=carried)) as bench, Cia402Drive(bench.exoskeleton) as drive:
        assert drive.can_comply
        powered(drive, bench)
        assert tick(drive, 0.1)[-1].interaction_nm == pytest.approx((0.0,) * 4, abs=0.5)
        bench.order("load elbow 9")  # towards larger joint angles, which is less flexion: the sign is -1
        reading = tick(drive, 0.3)[-1]
        assert reading.interaction_nm[3] == pytest.approx(-7.0, abs=0.3)


def test_sr8_a_drive_that_lies_about_its_place_is_found_by_the_leap(bench: Bench) -> None:
    with Cia402Drive(bench.exoskeleton) as drive:
        powered(drive, bench)
        bench.order("lie elbow 0.3")
        assert fault_of(drive) == "The drive of 'elbow' measures a place that it cannot have moved to."


def test_sr8_a_drive_that_lags_is_found_by_what_it_is_told(bench: Bench) -> None:
    with Cia402Drive(bench.exoskeleton) as drive:
        start = powered(drive, bench).angle_rad
        bench.order("lag elbow 0.9")
        away = lambda _, t_s: follow(tuple(angle + min(0.6 * t_s, 0.9) for angle in start))  # noqa: E731  # one line
        readings = tick(drive, 2.0, away, lambda reading: bool(reading.fault))
        assert readings[-1].fault == "The drive of 'elbow' does not follow: it is elsewhere than it is told to be."
