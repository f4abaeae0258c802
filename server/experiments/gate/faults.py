"""Single faults, as the safety gate meets them, and by when it must have left `engaged`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import nan
from random import Random
from typing import Final

from server.experiments.gate.rig import CONFIG, GOOD, TICK_S, GateRig, Scene
from server.messages import Hold, Pain, Stop
from server.station.exo.driver import ZERO, DriveReading, Joints
from server.station.exo.mapping import JointTarget
from server.station.exo.measured import ASTRAY_RAD, OLD_S
from server.station.exo.resistance import RESISTED_S

NEXT_TICK_S: Final = 1.5 * TICK_S
"""In the tick that meets it, and no later."""
FRESH_S: Final = 0.033
"""A frame of 30 Hz: so old may the newest evidence be when a sensor goes."""
STRONGEST: Final = 0.5
"""Of the torque that the drive may use: against more, less is left to brake with than has sped the arm up, and who
pushes with more than all of it is stopped by the device's own ends.
"""
NOTICED_S: Final = 0.25
"""A joint that does not follow faults within this time, a few ticks after `ASTRAY_S`."""


@dataclass(slots=True)
class Moment:
    """One tick of a fault: what it changes of a good one."""

    rig: GateRig
    since_s: float
    """Since the fault began, to the end of this tick."""
    source: Random
    first: DriveReading
    """Measured as it began."""
    target: JointTarget | None
    scene: Scene = GOOD
    push_nm: Joints = ZERO
    seconds: float = TICK_S
    """Since the tick before."""


@dataclass(frozen=True, slots=True)
class Fault:
    """One kind."""

    name: str
    spoil: Callable[[Moment], None]
    within_s: float
    """From when it counts to the gate's having left `engaged`."""
    counts: Callable[[Moment], bool] = lambda moment: True
    """Whether there is something to be noticed yet."""
    concerns_free: bool = True
    """It can be noticed where the arm is left free."""


def _sensors_silent(moment: Moment) -> None:
    moment.scene = replace(moment.scene, evidence_age_s=FRESH_S + moment.since_s)


def _target_lost(moment: Moment) -> None:
    moment.target = None


def _swing_unknown(moment: Moment) -> None:
    if moment.target is not None:
        moment.target = replace(moment.target, bound_rad=(0.8, 0.8, 0.1, 0.1))


def _service_silent(moment: Moment) -> None:
    moment.scene = replace(moment.scene, service_age_s=moment.since_s)


def _authority_lost(moment: Moment) -> None:
    moment.scene = replace(moment.scene, authority="")


def _computer_busy(moment: Moment) -> None:
    moment.scene = replace(moment.scene, interrupted="The computer is too busy.")


def _loop_stalls(moment: Moment) -> None:
    if moment.since_s < NEXT_TICK_S:
        moment.seconds = moment.source.uniform(0.11, 0.4)


def _drive_fault(moment: Moment) -> None:
    moment.scene = replace(moment.scene, spoilt=lambda reading: replace(reading, fault="The motor is hot."))


def _not_a_number(moment: Moment) -> None:
    moment.scene = replace(moment.scene, spoilt=lambda reading: replace(reading, angle_rad=(nan, *ZERO[1:])))


def _measurement_stops(moment: Moment) -> None:
    moment.scene = replace(moment.scene, spoilt=lambda reading: moment.first)


def _measurement_lies(moment: Moment) -> None:
    moment.scene = replace(moment.scene, spoilt=lambda reading: replace(moment.first, t_s=reading.t_s))


def _drive_is_deaf(moment: Moment) -> None:
    moment.scene = replace(moment.scene, obeyed=False)


def _resists(moment: Moment) -> None:
    """One joint pushes against its motion, or, where it stands still, towards its smaller angles."""
    i = int(moment.first.t_s / TICK_S) % len(ZERO)
    joint, speed = moment.rig.limits[i], moment.rig.command.velocity_rad_s[i]
    nm = max(1.1 * joint.resistance_nm, STRONGEST * joint.torque_nm)
    moment.push_nm = tuple((-nm if speed >= 0 else nm) if k == i else 0.0 for k in range(len(ZERO)))


def _leans(moment: Moment) -> None:
    """The person pushes all joints about, as strongly as may be without stopping the drive, one way for a while."""
    nm = [0.9 * joint.resistance_nm for joint in moment.rig.limits]
    ways = int(moment.since_s * 2) + int(moment.first.t_s / TICK_S)
    moment.push_nm = tuple(much if ways >> k & 1 else -much for k, much in enumerate(nm))


def _pain(moment: Moment) -> None:
    moment.rig.wish(Pain(number=1, reason="It hurts."))


def _stop(moment: Moment) -> None:
    moment.rig.wish(Stop(number=1, reason="stop"))


def _hold(moment: Moment) -> None:
    moment.rig.wish(Hold(number=1, reason="a pause"))


def _is_led(moment: Moment) -> bool:
    return moment.rig.state.facts.leads


def _is_astray(moment: Moment) -> bool:
    """A stiffly led joint is measured far from where it was commanded to be."""
    rig = moment.rig
    apart = map(lambda here, wanted: abs(here - wanted), rig.inputs.reading.angle_rad, rig.command.angle_rad)
    return any(much > ASTRAY_RAD and share >= 1.0 for much, share in zip(apart, rig.state.help.share, strict=True))


FAULTS: Final = (
    Fault("both sensors silent", _sensors_silent, CONFIG.stale_s - FRESH_S + NEXT_TICK_S, _is_led),
    Fault("target lost", _target_lost, NEXT_TICK_S, _is_led),
    Fault("swing too uncertain", _swing_unknown, CONFIG.resume_within_s + NEXT_TICK_S, _is_led),
    Fault("service silent", _service_silent, CONFIG.heartbeat_s + NEXT_TICK_S),
    Fault("nobody in charge", _authority_lost, NEXT_TICK_S),
    Fault("computer too busy", _computer_busy, NEXT_TICK_S),
    Fault("loop stood still", _loop_stalls, NEXT_TICK_S),
    Fault("drive reports a fault", _drive_fault, NEXT_TICK_S),
    Fault("measurement no number", _not_a_number, NEXT_TICK_S),
    Fault("measurement stops", _measurement_stops, OLD_S + NEXT_TICK_S),
    Fault("measurement lies", _measurement_lies, NOTICED_S, _is_astray, concerns_free=False),
    Fault("drive does not obey", _drive_is_deaf, NOTICED_S, _is_astray),
    Fault("arm resists", _resists, RESISTED_S + NEXT_TICK_S, _is_led),
    Fault("pain", _pain, NEXT_TICK_S),
    Fault("stop", _stop, NEXT_TICK_S),
    Fault("a person's hold", _hold, NEXT_TICK_S),
)
LEANING: Final = Fault("the person leans on the arm", _leans, float("inf"))
"""No fault: nothing needs to stop, but nothing may leave its range."""
