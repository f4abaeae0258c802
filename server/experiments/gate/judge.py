"""The judge of a tick: what of the command or of the measured joint is outside its limits (SR-1, SR-2).

A set-point may begin anew where the joint is measured (at engage and resume, and wherever the drive has been yielding);
any other step obeys velocity, acceleration and jerk.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import chain
from math import isfinite
from typing import Final

from server.experiments.gate.rig import GateRig
from server.messages import DriveState, JointLimits
from server.station.exo import measured
from server.station.exo.driver import DriveCommand
from server.station.exo.limiter import Box, Motion
from server.station.exo.safety import LONGEST_STEP_S, SHORTEST_STEP_S
from server.station.exo.set_points import as_measured

SLACK: Final = 1e-6
JUDGED: Final = (
    "joint: outside its range",
    *(f"command: {name}" for name in ("not a number", "range", "step", "velocity", "acceleration", "jerk", "torque")),
)
"""Everything that can be found."""


def excursions(rig: GateRig, tolerance_rad: float = 0.0) -> list[str]:
    """What was outside in the last tick, in a few words each; [] = nothing.

    Args:
        rig: after its tick.
        tolerance_rad: by which a joint may be outside its range; 0 where nobody pushes.
    """
    if not all(map(isfinite, _numbers(rig.command))):
        return ["command: not a number"]
    dt_s = min(max(rig.t_s - (rig.before.last_s or 0.0), SHORTEST_STEP_S), LONGEST_STEP_S)
    anew = _anew(rig)
    found = []
    for i, (joint, box) in enumerate(zip(rig.limits, rig.boxes, strict=True)):
        if not joint.min_rad - tolerance_rad <= rig.arm.angle_rad[i] <= joint.max_rad + tolerance_rad:
            found.append("joint: outside its range")
        if rig.command.torque_nm[i] > joint.torque_nm + SLACK:
            found.append("command: torque")
        ends = (joint.min_rad, joint.max_rad)
        steps = [_step(start, rig.state.motions[i], box, ends, dt_s) for start in (rig.before.motions[i], *anew[i])]
        found += sorted(steps, key=len)[0]
    return found


def _numbers(command: DriveCommand) -> chain[float]:
    return chain(command.angle_rad, command.velocity_rad_s, command.share, command.torque_nm)


def _anew(rig: GateRig) -> tuple[tuple[Motion, ...], ...]:
    """Per joint, from where else its set-point may have made its step: from where the arm was measured."""
    waits = rig.now in (DriveState.OFF, DriveState.READY)
    begins = rig.state.following and not rig.before.following
    free = rig.now is DriveState.ENGAGED and not rig.state.facts.leads
    if not (waits or begins or free or min(rig.before.help.share) < 1.0):
        return ((),) * len(rig.limits)
    before, elapsed_s = rig.before, rig.t_s - (rig.before.last_s or 0.0)
    reading = measured.sound(rig.inputs.reading, before.angle_rad, before.seen_rad, rig.t_s, elapsed_s)
    return tuple(map(_starts, as_measured(replace(rig.inputs, reading=reading)), rig.boxes, rig.limits))


def _starts(here: Motion, box: Box, joint: JointLimits) -> tuple[Motion, ...]:
    """Free, a set-point stays behind at the soft margin; stopped, at the end of the range."""
    ends = ((box.low_rad, box.high_rad), (joint.min_rad, joint.max_rad))
    return here, *(Motion(min(max(here.angle_rad, low), high)) for low, high in ends)


def _step(before: Motion, after: Motion, box: Box, ends_rad: tuple[float, float], dt_s: float) -> list[str]:
    velocity, acceleration = after.velocity_rad_s, after.acceleration_rad_s2
    low, high = min(ends_rad[0], before.angle_rad), max(ends_rad[1], before.angle_rad)
    beyond = {
        "range": max(low - after.angle_rad, after.angle_rad - high),
        "step": abs(after.angle_rad - before.angle_rad) - box.velocity_rad_s * dt_s,
        "velocity": abs(velocity) - box.velocity_rad_s,
        "acceleration": max(
            abs(acceleration) - box.acceleration_rad_s2,
            abs(velocity - before.velocity_rad_s) - box.acceleration_rad_s2 * dt_s,
        ),
        "jerk": abs(acceleration - before.acceleration_rad_s2) - box.jerk_rad_s3 * dt_s,
    }
    return [f"command: {name}" for name, much in beyond.items() if not much <= SLACK]
