"""Random and hostile inputs to the safety gate: limits, devices, targets, ages, measurements and wishes."""

from __future__ import annotations

from dataclasses import replace
from math import inf, nan
from random import Random
from typing import Final

from msgspec import structs

from server.config import StationConfig
from server.experiments.gate.rig import GateRig, opening
from server.messages import (
    Assistance,
    CloseSession,
    DriveState,
    Enable,
    Hold,
    JointLimits,
    Pain,
    Reset,
    Resume,
    SetAssistance,
    Stop,
    Wish,
)
from server.station.exo.driver import DriveReading, Joints
from server.station.exo.evidence import Device
from server.station.exo.mapping import JointTarget
from server.station.exo.softness import device_of

STATION: Final = StationConfig()
NARROWEST_RAD: Final = 0.3
NO_NUMBERS: Final = (nan, inf, -inf, 1e300, -1e300)
SURE: Final = (0.1,) * 4
FREELY: Final = (1.0,) * 4
STILL: Final = (0.0,) * 4


def limits(source: Random) -> tuple[JointLimits, ...]:
    """A patient's, somewhere inside the device's."""
    return tuple(_joint_limits(source, outer) for outer in STATION.device)


def _joint_limits(source: Random, outer: JointLimits) -> JointLimits:
    width = source.uniform(NARROWEST_RAD, outer.max_rad - outer.min_rad)
    low = source.uniform(outer.min_rad, outer.max_rad - width)
    torque_nm = source.uniform(8.0, 15.0)
    return structs.replace(
        outer,
        min_rad=low,
        max_rad=low + width,
        velocity_rad_s=source.uniform(0.3, outer.velocity_rad_s),
        acceleration_rad_s2=source.uniform(2.0, outer.acceleration_rad_s2),
        torque_nm=torque_nm,
        resistance_nm=source.uniform(0.3, 0.45) * torque_nm,
    )


def device(source: Random) -> Device:
    """Most can comply; some of their joints stop softly."""
    soft = tuple(source.random() < 0.3 for _ in range(4))
    return replace(device_of(STATION.exoskeleton, source.random() < 0.7), soft_stop=soft)


def near_target(angle_rad: Joints) -> JointTarget:
    """A sure target where the arm is."""
    return JointTarget(angle_rad, STILL, SURE, FREELY)


def target(source: Random, rig: GateRig) -> JointTarget | None:
    """A jump, an end of the range, a tremble, or nonsense."""
    kind = source.random()
    if kind < 0.01:
        return None
    if kind < 0.5:
        angle = tuple(source.gauss(0.7, 1.2) for _ in range(4))
    elif kind < 0.75:
        angle = tuple(source.choice((joint.min_rad, joint.max_rad)) + source.gauss(0, 0.3) for joint in rig.limits)
    else:
        angle = tuple(here + source.gauss(0, 0.1) for here in rig.command.angle_rad)
    velocity = tuple(source.gauss(0, 3.0) for _ in range(4))
    bound = tuple(abs(source.gauss(0, 0.3)) for _ in range(4))
    freedom = tuple(source.choice((1.0, 1.0, source.random())) for _ in range(4))
    made = JointTarget(angle, velocity, bound, freedom)
    return _spoilt_target(source, made) if source.random() < 0.01 else made


def _spoilt_target(source: Random, made: JointTarget) -> JointTarget:
    part = source.choice(("angle_rad", "velocity_rad_s", "bound_rad", "freedom"))
    return replace(made, **{part: spoilt(source, getattr(made, part))})


def spoilt(source: Random, numbers: Joints) -> Joints:
    """One of them is no number, or one is missing, or there is one too many."""
    kind = source.randrange(3)
    if kind == 0:
        return numbers[:-1]
    if kind == 1:
        return (*numbers, 0.0)
    at = source.randrange(len(numbers))
    return (*numbers[:at], source.choice(NO_NUMBERS), *numbers[at + 1 :])


def spoilt_reading(source: Random, reading: DriveReading) -> DriveReading:
    """A measurement that is broken, old, or of the future."""
    if source.random() < 0.3:
        return replace(reading, t_s=source.choice((reading.t_s - 1.0, reading.t_s + 1.0, nan, -inf)))
    part = source.choice(("angle_rad", "velocity_rad_s", "torque_nm", "interaction_nm"))
    wrong = spoilt(source, getattr(reading, part))
    return replace(reading, **{part: wrong})  # type: ignore[arg-type]  # of the parts that are numbers per joint


def wish(source: Random) -> Wish:
    """Any wish, whether or not it makes sense now."""
    mode = source.choice(list(Assistance))
    level = source.choice((0.0, 1.0, source.random(), source.random(), -1.0, 2.0, nan, inf))
    return source.choice(
        (
            opening(mode, level),
            CloseSession(number=1),
            Enable(number=1),
            Resume(number=1),
            Reset(number=1),
            Hold(number=1, reason="a pause"),
            Pain(number=1, reason="it hurts"),
            Stop(number=1, reason="stop"),
            SetAssistance(number=1, mode=mode, level=level),
        )
    )


_ONWARD: Final[dict[DriveState, Wish]] = {
    DriveState.OFF: opening(),
    DriveState.READY: Enable(number=1),
    DriveState.HOLD: Resume(number=1),
    DriveState.STOPPED: Reset(number=1),
    DriveState.FAULT: Reset(number=1),
}


def onward(rig: GateRig) -> bool:
    """A person brings the gate a state nearer to engaged, if it lets them."""
    return rig.wish(_ONWARD[rig.now])
