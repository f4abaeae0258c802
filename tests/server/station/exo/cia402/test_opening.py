"""What does not fit is refused at start, with joint, node, key and what was expected."""

from __future__ import annotations

from contextlib import ExitStack

import msgspec
import pytest
from cia402_bench import Bench, emulated, follow, four_joints, powered, tick

from fusion.errors import InputError, MachineError
from server.exoskeleton import BUILT_IN, Cia402Settings, ExoskeletonJoint
from server.station.exo.cia402 import Cia402Drive, objects
from server.station.exo.cia402.objects import Entry


def _refusal(bench: Bench, **joint: object) -> str:
    """Open a device whose file says something else of the elbow than what is on the bus."""
    joints = (*bench.exoskeleton.joints[:3], msgspec.structs.replace(bench.exoskeleton.joints[3], **joint))
    with pytest.raises(MachineError) as refused, Cia402Drive(msgspec.structs.replace(bench.exoskeleton, joints=joints)):
        pass
    return str(refused.value)


def _elbow_with(bench: Bench, entry: Entry, value: int) -> None:
    bench.nodes["elbow"].drive.values[entry] = value


def test_an_absent_node_is_named(bench: Bench) -> None:
    said = _refusal(bench, node=9)
    assert "'elbow' (joints[3].node = 9) does not answer" in said
    assert "cia402.bitrate" in said


def test_a_node_that_is_no_drive_is_named(bench: Bench) -> None:
    _elbow_with(bench, objects.DEVICE_TYPE, 0x191)
    said = _refusal(bench)
    assert "profile 401" in said
    assert "Expected: profile 402" in said
    assert "joints[3].node" in said


def test_a_node_without_heartbeat_is_named(bench: Bench) -> None:
    bench.order("no-heartbeat elbow")
    assert "'elbow' (joints[3].node = 4) sends no heartbeat" in _refusal(bench)


def test_sr1_limits_that_a_drive_refuses_or_keeps_otherwise_end_the_start(bench: Bench) -> None:
    bench.order("refuse-limits elbow")
    assert "does not take" in _refusal(bench)
    bench.order("well elbow")
    bench.order("false-limits elbow")
    said = _refusal(bench)
    assert "607Dh:01" in said
    assert "joints[3].min_rad" in said
    assert f"Expected: {round(-2.4 * 65536 * 100 / 6.283185307179586)}" in said


def test_another_encoder_than_the_files_is_named(bench: Bench) -> None:
    said = _refusal(bench, counts_per_turn=4096)
    assert "608Fh" in said
    assert "joints[3].counts_per_turn" in said


def test_a_drive_that_turns_the_other_way_by_its_own_setting_is_named(bench: Bench) -> None:
    _elbow_with(bench, objects.POLARITY, 0x80)
    said = _refusal(bench)
    assert "607Eh" in said
    assert "joints[3].sign" in said


def test_a_drive_without_the_cyclic_mode_is_named(bench: Bench) -> None:
    _elbow_with(bench, objects.SUPPORTED_MODES, objects.MODE_BITS[objects.HOMING])
    assert "has no mode 8" in _refusal(bench)


def test_a_joint_that_is_not_homed_is_not_moved(bench: Bench) -> None:
    bench.order("forget elbow")
    said = _refusal(bench)
    assert "'elbow' (joints[3].node = 4) is not homed" in said
    assert "mirrorlimb exoskeleton home" in said
    assert bench.states() == {"switch on disabled"}


def test_absolute_encoders_need_no_homing() -> None:
    with emulated(four_joints(homing_method=0)) as bench:
        bench.nodes["elbow"].drive.forget()
        bench.nodes["elbow"].place(-0.8)
        with Cia402Drive(bench.exoskeleton):
            pass


def test_a_joint_outside_its_own_range_is_not_powered(bench: Bench) -> None:
    bench.order("place elbow 0.5")
    said = _refusal(bench)
    assert "stands at 0.50 rad, outside its own range" in said
    assert "-2.40 to 0.30 rad" in said
    assert bench.states() == {"switch on disabled"}


def test_a_joint_that_follows_nothing_is_not_moved_to_its_rest_but_refused_far_from_it() -> None:
    exoskeleton = four_joints()
    wrist = msgspec.structs.replace(BUILT_IN.joints[5], node=5, rest_rad=0.1)
    with emulated(msgspec.structs.replace(exoskeleton, joints=(*exoskeleton.joints, wrist))) as bench:
        bench.order("place wrist flexion 0.25")
        with Cia402Drive(bench.exoskeleton) as drive:
            start = powered(drive, bench).angle_rad
            tick(drive, 0.4, lambda *_: follow(start))
            assert bench.angles()["wrist flexion"] == pytest.approx(0.25, abs=2e-3)
        bench.order("place wrist flexion 0.35")
        with pytest.raises(MachineError, match=r"joints\[4\].rest_rad = 0\.1"), Cia402Drive(bench.exoskeleton):
            pass


def test_sr1_every_limit_is_in_the_drive_after_the_start(bench: Bench) -> None:
    with Cia402Drive(bench.exoskeleton):
        values, counts = bench.nodes["elbow"].drive.values, 65536 * 100 / 6.283185307179586
        assert values[objects.MIN_POSITION] == round(-2.4 * counts)
        assert values[objects.MAX_POSITION] == round(0.3 * counts)
        assert values[objects.MAX_PROFILE_VELOCITY] == round(2.0 * counts)
        assert values[objects.MAX_MOTOR_SPEED] == round(2.0 * 100 * 60 / 6.283185307179586)
        assert values[objects.MAX_ACCELERATION] == round(10.0 * counts)
        assert values[objects.MAX_TORQUE] == values[objects.MAX_CURRENT] == 250
        assert values[objects.CONSUMER_HEARTBEAT] == 127 << 16 | 1000
        assert (values[objects.ABORT_OPTION], values[objects.QUICK_STOP_OPTION]) == (3, 6)
        assert (values[objects.INTERPOLATION_TIME], values[objects.INTERPOLATION_EXPONENT]) == (10, -3)


def test_a_bus_that_cannot_be_opened_is_named() -> None:
    with (
        pytest.raises(MachineError, match=r"nonsense can0.*cia402\.interface"),
        Cia402Drive(
            msgspec.structs.replace(four_joints(), cia402=Cia402Settings(interface="nonsense", channel="can0"))
        ),
    ):
        pass


def test_a_bus_that_is_too_slow_for_its_joints_is_refused() -> None:
    with pytest.raises(InputError, match=r"cia402\.bitrate: 4 joints"):
        Cia402Drive(four_joints(bitrate=125_000))


def test_a_refused_start_leaves_no_thread_and_no_bus(bench: Bench) -> None:
    bench.order("silent all")
    with ExitStack() as stack, pytest.raises(MachineError):
        stack.enter_context(Cia402Drive(bench.exoskeleton))
    bench.order("silent all 0")
    with Cia402Drive(bench.exoskeleton):
        assert all(isinstance(joint, ExoskeletonJoint) for joint in bench.exoskeleton.joints)
