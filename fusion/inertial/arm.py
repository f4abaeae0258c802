"""One arm from three inertial sensors: pose, movement, headings, angles, chain; the whole idea on one page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.spatial.transform import Rotation

from fusion.errors import InputError
from fusion.geometry import Floats
from fusion.inertial.chain import ArmAngles, joint_positions
from fusion.inertial.heading import Heading, Hinge, find_hinge, find_wrist_heading
from fusion.inertial.long_axes import LongAxes
from fusion.inertial.orientation import Oriented
from fusion.messages import ArmLengths
from fusion.skeleton import Side

SEGMENTS: Final = ("upper-arm", "forearm", "hand")
FLEXION_RANGE_RAD: Final = (np.radians(-10.0), np.radians(160.0))
"""What an elbow can do, from overstretched to touching the upper arm; the chain keeps to it."""

MOST_HANGING_FLEXION_RAD: Final = np.radians(20.0)
STRAIGHTEST_PERCENT: Final = 1.0


@dataclass(frozen=True, slots=True)
class ArmSensors:
    """The three oriented sensors of an arm, on one clock."""

    upper_arm: Oriented
    forearm: Oriented
    hand: Oriented


@dataclass(frozen=True, slots=True)
class InertialArm:
    """Where an arm was, in a frame with the shoulder at its origin, and how the sensors sat on it."""

    side: Side
    t_s: Floats  # (T,)
    angles: ArmAngles
    positions: Floats  # (T, 4, 3) m: shoulder, elbow, wrist, hand; x to the right, y up, z to the back
    long_axes: LongAxes
    hanging_flexion_rad: float
    """How far the elbow was bent while the arm hung, as learnt from its straightest moments; 0 without a pose."""
    off_hinge_rad: float
    """Root mean square of the turn that a two-axis elbow cannot have: the error of headings and calibration."""


def sides_worn(sites: Sequence[str]) -> tuple[Side, ...]:
    """The sides with sensors on an arm.

    Raises:
        InputError: there is none, or an arm lacks one of its three.
    """
    wanted = {side: [f"{segment}-{side.value}" for segment in SEGMENTS] for side in Side}
    worn = tuple(side for side in Side if set(wanted[side]) & set(sites))
    missing = [site for side in worn for site in wanted[side] if site not in sites]
    if missing or not worn:
        what = f"no imu stream has the site {', '.join(missing)}" if missing else "no imu stream sits on an arm"
        expected = "upper-arm-, forearm- and hand- with left or right"
        raise InputError(what, expected, f"name the sites in recording.json (found: {', '.join(sites) or 'none'})")
    return worn


def track_arm(side: Side, sensors: ArmSensors, lengths: ArmLengths, long_axes: LongAxes) -> InertialArm:
    """Follow an arm.

    x of the arm's frame is where the elbow's axis pointed while the arm hung (or in the first seconds): no inertial
    sensor without magnetometer knows another horizontal direction, and it drifts with the upper arm's gyroscope.

    Raises:
        InputError: the arm hardly moved, so neither axis nor headings can be learnt.
    """
    upper, forearm, hand = sensors.upper_arm, sensors.forearm, sensors.hand
    hinge = find_hinge(upper, forearm, long_axes.upper_arm, long_axes.forearm)
    wrist = find_wrist_heading(forearm, hand, long_axes.forearm)
    upper_turn, forearm_turn, hand_turn = _segment_rotations(sensors, hinge, wrist, long_axes)
    hanging_flexion_rad = 0.0 if long_axes.pose is None else _hanging_flexion_rad(upper_turn, forearm_turn)
    angles, off_hinge = _angles(upper_turn, forearm_turn * _about_x(hanging_flexion_rad), hand_turn)
    positions = joint_positions(angles, lengths)
    off_hinge_rad = float(np.sqrt(np.mean(off_hinge**2)))
    return InertialArm(side, upper.t_s, angles, positions, long_axes, hanging_flexion_rad, off_hinge_rad)


def _segment_rotations(
    sensors: ArmSensors, hinge: Hinge, wrist: Heading, long_axes: LongAxes
) -> tuple[Rotation, Rotation, Rotation]:
    """Turns of upper arm, forearm and hand since they hung, in the arm's frame, (T,) each."""
    t_s, upper = sensors.upper_arm.t_s, sensors.upper_arm.sensor_to_earth
    forearm = hinge.heading.rotation() * sensors.forearm.sensor_to_earth
    hand = hinge.heading.rotation() * wrist.rotation() * sensors.hand.sensor_to_earth
    x_in_earth = upper.apply(hinge.axis) * _sign(upper, forearm, hinge, long_axes)  # (T, 3)
    earth_to_arm = _frame(x_in_earth[long_axes.begin(t_s)].mean(axis=0), np.array([0.0, 0.0, 1.0])).inv()
    straight = hand.inv().apply(forearm.apply(long_axes.forearm)).mean(axis=0)
    ups = [long_axes.upper_arm, long_axes.forearm, straight if long_axes.hand is None else long_axes.hand]
    counted = long_axes.counted(t_s)
    rotations = []
    for rotation, up in zip((upper, forearm, hand), ups, strict=True):
        x_in_sensor = rotation[counted].inv().apply(x_in_earth[counted]).mean(axis=0)
        rotations.append(earth_to_arm * rotation * _frame(x_in_sensor, up / np.linalg.norm(up)))
    return rotations[0], rotations[1], rotations[2]


def _sign(upper: Rotation, forearm: Rotation, hinge: Hinge, long_axes: LongAxes) -> float:
    """The sign of the hinge with which elbows bend forward: mostly the forearm is in front of the upper arm."""
    axis, up = upper.apply(hinge.axis), upper.apply(long_axes.upper_arm)
    bend = np.sum(np.cross(up, forearm.apply(long_axes.forearm)) * axis, axis=1)
    return 1.0 if bend.mean() >= 0 else -1.0


def _frame(x: Floats, y: Floats) -> Rotation:
    """The frame with that y, and x as near as it can be; its axes as columns."""
    x = x - y * (x @ y)
    x = x / np.linalg.norm(x)
    return Rotation.from_matrix(np.stack([x, y, np.cross(x, y)], axis=-1))


def _hanging_flexion_rad(upper: Rotation, forearm: Rotation) -> float:
    """A relaxed elbow hangs bent by some 10–15°, which gravity cannot tell; but no elbow goes past straight."""
    hanging = 0.0
    for _ in range(5):  # a fixed point, as the forearm may be turned while it is straightest
        flexion = (upper.inv() * forearm * _about_x(hanging)).as_euler("XZY")[:, 0]
        straightest = float(np.percentile(flexion, STRAIGHTEST_PERCENT))
        hanging = float(np.clip(hanging - straightest, 0.0, MOST_HANGING_FLEXION_RAD))
    return hanging


def _about_x(angle_rad: float) -> Rotation:
    return Rotation.from_rotvec([angle_rad, 0.0, 0.0])


def _angles(upper: Rotation, forearm: Rotation, hand: Rotation) -> tuple[ArmAngles, Floats]:
    """The chain's seven angles, and the elbow's turn about the axis that it does not have."""
    flexion, off_hinge, pronation = (upper.inv() * forearm).as_euler("XZY").T
    wrist_flexion, deviation, _ = (forearm.inv() * hand).as_euler("XZY").T
    flexion = np.clip(flexion, *FLEXION_RANGE_RAD)
    return ArmAngles(upper.as_rotvec(), flexion, pronation, wrist_flexion, deviation), off_hinge
