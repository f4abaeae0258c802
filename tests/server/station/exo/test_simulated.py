"""The simulated exoskeleton behaves like a drive that carries an arm."""

from __future__ import annotations

from math import sin

import msgspec
import numpy as np
import pytest
from station_samples import patient_limits

from fusion.kinematics.angles import direction_from_swing, forearm_from_twist
from server.config import StationConfig
from server.exoskeleton import device_limits
from server.station.exo.arm_load import GRAVITY_M_S2, ArmLoad
from server.station.exo.driver import ZERO, DriveCommand, DriveMode
from server.station.exo.simulated import AT_REST, PLANTS, RAMP_RAD_S2, SimulatedDrive

EXOSKELETON = StationConfig().exoskeleton


def _drive() -> SimulatedDrive:
    drive = SimulatedDrive(EXOSKELETON)
    drive.read(0.0)
    return drive


def _height(load: ArmLoad, angle: np.ndarray) -> float:
    """Potential energy over g, from the project's own forward kinematics."""
    upper = direction_from_swing(angle[0], angle[1])
    fore = forearm_from_twist(upper, angle[2], angle[3])
    elbow = load.upper_arm_m * upper[1]
    return load.upper_arm_kg * load.upper_arm_centre_m * upper[1] + load.forearm_kg * (
        elbow + load.forearm_centre_m * fore[1]
    )


def test_gravity_is_the_slope_of_the_arms_height() -> None:
    load, random, step = ArmLoad(), np.random.default_rng(1), 1e-6
    for _ in range(50):
        angle = random.uniform((-0.5, 0.1, -1.2, 0.0), (2.0, 2.4, 1.2, 2.4))
        slope = [
            -GRAVITY_M_S2 * (_height(load, angle + move) - _height(load, angle - move)) / (2 * step)
            for move in np.eye(4) * step
        ]
        assert load.gravity_nm(tuple(angle)) == pytest.approx(slope, abs=1e-5)


def test_sr7_without_any_command_the_arm_does_not_fall() -> None:
    drive = _drive()
    assert drive.read(3.0).angle_rad == pytest.approx(AT_REST, abs=0.02)


def test_a_heavier_arm_than_the_drive_knows_hangs_a_little_lower_and_is_held_by_torque() -> None:
    drive = _drive()
    for tick in range(300):
        raised = (0.6, 1.4, 0.0, 0.6)
        drive.command(DriveCommand(DriveMode.HOLD, raised, ZERO, ""), tick * 0.01)
    reading = drive.read(3.0)
    assert -0.02 < reading.angle_rad[1] - 1.4 < 0.0
    assert reading.torque_nm[1] > 5


def test_a_smooth_command_is_followed_within_a_hundredth_of_a_radian() -> None:
    drive, worst = _drive(), 0.0
    for tick in range(500):
        t_s = tick * 0.01
        angle = tuple(rest + 0.25 * (1 - np.cos(1.5 * t_s)) for rest in AT_REST)
        speed = (0.25 * 1.5 * sin(1.5 * t_s),) * 4
        worst = max(worst, max(abs(a - b) for a, b in zip(drive.read(t_s).angle_rad, angle, strict=True)))
        drive.command(DriveCommand(DriveMode.FOLLOW, angle, speed, ""), t_s)
    assert worst < 0.02


def test_sr2_torque_stays_inside_what_the_motor_can_give() -> None:
    drive = _drive()
    for tick in range(100):
        far = (2.0, 2.4, 1.5, 2.4) if tick % 20 < 10 else (-0.5, 0.0, -1.5, 0.0)
        drive.command(DriveCommand(DriveMode.FOLLOW, far, ZERO, ""), tick * 0.01)
        torque = drive.read(tick * 0.01 + 0.009).torque_nm
        assert all(abs(t) <= plant.torque_nm for t, plant in zip(torque, PLANTS, strict=True))


def test_the_devices_stops_are_hard() -> None:
    drive = _drive()
    for tick in range(300):
        drive.command(DriveCommand(DriveMode.FOLLOW, (9.0,) * 4, ZERO, ""), tick * 0.01)
        measured = drive.read(tick * 0.01 + 0.005).angle_rad
        assert all(low.min_rad <= a <= low.max_rad for a, low in zip(measured, device_limits(EXOSKELETON), strict=True))


def test_sr3_when_commands_cease_the_drive_comes_to_rest_by_itself_and_stays() -> None:
    drive, angle = _drive(), AT_REST
    for tick in range(100):
        angle = tuple(a + 0.005 for a in angle)
        drive.command(DriveCommand(DriveMode.FOLLOW, angle, (0.5,) * 4, ""), tick * 0.01)
    still_s = 0.99 + 0.1 + 0.5 / RAMP_RAD_S2 + 0.15
    at_rest = drive.read(still_s)
    assert max(map(abs, at_rest.velocity_rad_s)) < 0.02
    assert drive.read(still_s + 2.0).angle_rad == pytest.approx(at_rest.angle_rad, abs=0.01)
    assert all(a - b < 0.5 * 0.2 for a, b in zip(at_rest.angle_rad, angle, strict=True))


def test_fitting_an_arm_brings_every_joint_inside_the_patients_range() -> None:
    drive = _drive()
    narrow = tuple(msgspec.structs.replace(limits, min_rad=1.0, max_rad=1.5) for limits in patient_limits())
    drive.fit(narrow)
    assert all(1.0 < angle < 1.5 for angle in drive.read(0.01).angle_rad)
    assert drive.read(1.0).angle_rad == pytest.approx(drive.read(0.01).angle_rad, abs=0.02)


def test_the_same_commands_give_the_same_movement_however_often_it_is_read() -> None:
    seldom, often = _drive(), _drive()
    for tick in range(50):
        command = DriveCommand(DriveMode.FOLLOW, tuple(a + 0.004 * tick for a in AT_REST), (0.4,) * 4, "")
        for drive in (seldom, often):
            drive.command(command, tick * 0.01)
        for part in range(1, 5):
            often.read(tick * 0.01 + part * 0.002)
    assert seldom.read(0.5).angle_rad == pytest.approx(often.read(0.5).angle_rad, abs=1e-3)
