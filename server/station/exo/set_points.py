"""How the set-points move in each state: led to the target, left to the person, brought to rest, or giving way."""

from __future__ import annotations

from dataclasses import replace

from server.config import GateConfig
from server.messages import EXO_JOINTS, DriveState, JointLimits
from server.station.exo import evidence
from server.station.exo.brake import Brake
from server.station.exo.driver import ONE, Joints
from server.station.exo.evidence import SafetyInputs
from server.station.exo.limiter import Box, Motion, to_rest, towards
from server.station.exo.mapping import JointTarget
from server.station.exo.safety_state import SafetyState

MOVED_BY_HAND_RAD = 0.05
STILL_RAD_S = 0.05
"""A measured velocity below this is noise."""
GIVING_WAY = 0.5
"""Share of the velocity limit at which a set-point goes back to where the arm began to resist."""
ARRIVED_RAD = 1e-3


def led(
    state: SafetyState, inputs: SafetyInputs, target: JointTarget, free: Joints, dt_s: float, config: GateConfig
) -> tuple[SafetyState, tuple[str, ...]]:
    """Follow the target inside every limit; what was clamped is said in words."""
    state = state if state.following else _begun(state, inputs, evidence.distance_rad(target, inputs, free), config)
    blend = min(state.blend + dt_s / state.blend_over_s, 1.0)
    more = dt_s / config.blend_s
    thaw = tuple(min(thawed + more, 1.0) if speed else 0.0 for thawed, speed in zip(state.thaw, free, strict=True))
    speed = tuple(f * t for f, t in zip(free, thaw, strict=True))
    eased = blend * blend * (3 - 2 * blend)
    motions, clamped = [], []
    for i, (motion, box) in enumerate(zip(state.motions, inputs.boxes, strict=True)):
        goal = state.blend_from[i] + eased * (target.angle_rad[i] - state.blend_from[i])
        motions.append(towards(motion, goal, eased * target.velocity_rad_s[i], box, speed[i] * target.freedom[i], dt_s))
        clamped += _clamped(EXO_JOINTS[i], goal, free[i], box)
    return replace(state, motions=tuple(motions), blend=blend, thaw=thaw, speed=speed), tuple(clamped)


def _begun(state: SafetyState, inputs: SafetyInputs, apart_rad: Joints, config: GateConfig) -> SafetyState:
    """The first set-point is where the arm is; the further the target, the longer the way there (SR-6)."""
    return replace(
        state,
        motions=as_measured(inputs),
        following=True,
        blend=0.0,
        blend_over_s=max(config.blend_s, max(apart_rad) / config.blend_rad_s),
        blend_from=inputs.reading.angle_rad,
        thaw=ONE,
    )


def _clamped(joint: str, goal_rad: float, free: float, box: Box) -> list[str]:
    words = []
    if not box.low_rad <= goal_rad <= box.high_rad:
        words.append(f"{joint}: at the end of its range")
    if free < 1.0:
        words.append(f"{joint}: {'slowed' if free else 'held'}, its target is uncertain or old")
    return words


def as_measured(inputs: SafetyInputs) -> tuple[Motion, ...]:
    """Set-points where the arm is, moving as it moves, but no faster than its limits and the room ahead allow."""
    return tuple(map(_measured, inputs.reading.angle_rad, inputs.reading.velocity_rad_s, inputs.boxes))


def _measured(angle_rad: float, velocity_rad_s: float, box: Box) -> Motion:
    if abs(velocity_rad_s) < STILL_RAD_S:
        return Motion(angle_rad)
    moving = Motion(angle_rad, min(max(velocity_rad_s, -box.velocity_rad_s), box.velocity_rad_s))
    brake = Brake.of(moving, box.acceleration_rad_s2, box.jerk_rad_s3)
    return moving if box.low_rad <= brake.low_rad and brake.high_rad <= box.high_rad else Motion(angle_rad)


def left_free(state: SafetyState, inputs: SafetyInputs) -> SafetyState:
    """The set-points go with the arm; beyond the soft margin they stay behind, and the wall draws it back to them."""
    motions = tuple(
        motion if box.low_rad <= motion.angle_rad <= box.high_rad else Motion(_inside(motion.angle_rad, box))
        for motion, box in zip(as_measured(inputs), inputs.boxes, strict=True)
    )
    return replace(state, motions=motions, following=False, blend=1.0, speed=ONE)


def _inside(angle_rad: float, box: Box) -> float:
    return min(max(angle_rad, box.low_rad), box.high_rad)


def rested(state: SafetyState, inputs: SafetyInputs, dt_s: float) -> SafetyState:
    """Come to rest the fastest way, then hold; before anything was enabled, hold where the arm is."""
    motions = _taken_over(state, inputs) if state.following else state.motions
    state = replace(state, following=False, blend=0.0, motions=_resting(replace(state, motions=motions), inputs, dt_s))
    return state


def _taken_over(state: SafetyState, inputs: SafetyInputs) -> tuple[Motion, ...]:
    """An arm that was not led stiffly need not be where its set-point is: it is brought to rest from where it is."""
    joints = zip(state.help.share, state.motions, as_measured(inputs), inputs.limits, strict=True)
    return tuple(_in_range(here, joint) if share < 1.0 else motion for share, motion, here, joint in joints)


def _in_range(motion: Motion, joint: JointLimits) -> Motion:
    if joint.min_rad <= motion.angle_rad <= joint.max_rad:
        return motion
    return Motion(min(max(motion.angle_rad, joint.min_rad), joint.max_rad))


def _resting(state: SafetyState, inputs: SafetyInputs, dt_s: float) -> tuple[Motion, ...]:
    if state.yielded_at is not None and inputs.boxes:
        joints = zip(state.motions, state.yielded_at, inputs.boxes, strict=True)
        return tuple(_given_way(motion, place, box, dt_s) for motion, place, box in joints)
    if not state.at_rest:
        return tuple(to_rest(motion, box, dt_s) for motion, box in zip(state.motions, inputs.boxes, strict=True))
    if state.gate.state in (DriveState.OFF, DriveState.READY) and not state.facts.fault:
        return tuple(map(_kept, state.motions, inputs.reading.angle_rad))
    return state.motions


def _given_way(motion: Motion, place_rad: float, box: Box, dt_s: float) -> Motion:
    """Back to where the arm was when it began to resist: what the set-point had been ahead pushes no longer."""
    if abs(motion.angle_rad - place_rad) < ARRIVED_RAD and abs(motion.velocity_rad_s) < STILL_RAD_S:
        return to_rest(motion, box, dt_s)
    return towards(motion, place_rad, 0.0, box, GIVING_WAY, dt_s)


def _kept(motion: Motion, measured_rad: float) -> Motion:
    """Where a joint is held; follows the arm only if somebody moves it, or its weight would pull it down bit by bit."""
    return Motion(measured_rad) if abs(measured_rad - motion.angle_rad) > MOVED_BY_HAND_RAD else motion
