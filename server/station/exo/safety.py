"""The safety gate: pure; a state and a tick's inputs in, the next state and the drive's command out."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import inf

from server.config import GateConfig
from server.messages import EXO_JOINTS, DriveState, Wish
from server.station.exo import evidence, gate
from server.station.exo.driver import ONE, ZERO, DriveCommand, DriveMode, DriveReading, Joints
from server.station.exo.evidence import SafetyInputs
from server.station.exo.gate import Facts, GateState
from server.station.exo.limiter import Box, Motion, to_rest, towards
from server.station.exo.mapping import JointTarget

SHORTEST_STEP_S = 1e-4
MOVED_BY_HAND_RAD = 0.05
TOO_SOON = "The exoskeleton's state has only just changed; ask again."
LONGEST_STEP_S = 0.02
"""A set-point never moves further than this much time allows, however late the tick."""


@dataclass(frozen=True, slots=True)
class SafetyState:
    """Everything the gate remembers."""

    gate: GateState = field(default_factory=GateState)
    motions: tuple[Motion, ...] = (Motion(0.0),) * len(EXO_JOINTS)
    """The set-points."""
    following: bool = False
    """The last tick followed the target."""
    blend: float = 0.0
    """0..1 of the blend-in (SR-6)."""
    blend_over_s: float = inf
    """How long the blend-in takes."""
    blend_from: Joints = ZERO
    thaw: Joints = ZERO
    """0..1 per joint: a joint that was held comes back as slowly as a blend-in."""
    frozen_s: float = 0.0
    """How long the swing has been held by uncertainty."""
    facts: Facts = field(default_factory=Facts)
    """Of the last tick; what a person saw who wishes now."""
    speed: Joints = ONE
    """0..1 per joint: what uncertainty and age leave of its speed (SR-4)."""
    last_s: float | None = None

    @property
    def at_rest(self) -> bool:
        """Whether every set-point stands still."""
        return not any(motion.velocity_rad_s for motion in self.motions)


def wish(state: SafetyState, wanted: Wish, now_s: float) -> tuple[SafetyState, str]:
    """Apply a person's wish at the tick's head; the second value says why it was refused ("" = granted).

    A granted wish outdates the facts: what comes in the same tick could be judged by another session's, or resume an
    arm that has not begun to brake.
    """
    after, refusal = gate.wish(state.gate, wanted, state.facts, now_s)
    if refusal:
        return state, refusal
    return replace(state, gate=after, facts=replace(state.facts, blockers=(*state.facts.blockers, TOO_SOON))), ""


def put_in(state: SafetyState, reading: DriveReading) -> SafetyState:
    """Somebody has put an arm in: what is held from now on is where it lies, not where the last one lay."""
    expected = tuple(motion.angle_rad for motion in state.motions)
    return replace(state, motions=tuple(map(Motion, evidence.sound(reading, expected).angle_rad)))


def step(
    state: SafetyState, inputs: SafetyInputs, config: GateConfig, now_s: float
) -> tuple[SafetyState, DriveCommand]:
    """One tick: judge, change state where that is due, move the set-points inside every limit."""
    elapsed_s = 0.0 if state.last_s is None else max(now_s - state.last_s, 0.0)
    expected = tuple(motion.angle_rad for motion in state.motions)
    inputs = replace(inputs, reading=evidence.sound(inputs.reading, expected))
    target = evidence.usable(inputs.target)
    free = evidence.free_speed(target, inputs.evidence_age_s, config)
    state = _judged(state, inputs, target, free, elapsed_s, config)
    state = replace(state, gate=gate.watch(state.gate, state.facts, config, now_s), last_s=now_s)
    dt_s = min(max(elapsed_s, SHORTEST_STEP_S), LONGEST_STEP_S)
    if state.gate.state is DriveState.ENGAGED and target is not None:
        begun = state if state.following else _begun(state, inputs, evidence.distance_rad(target, inputs, free), config)
        return _follow(begun, inputs, target, free, dt_s, config)
    return _rest(replace(state, following=False, blend=0.0), inputs, dt_s)


def _judged(
    state: SafetyState,
    inputs: SafetyInputs,
    target: JointTarget | None,
    free: Joints,
    elapsed_s: float,
    config: GateConfig,
) -> SafetyState:
    """The tick's facts."""
    engaged = state.gate.state is DriveState.ENGAGED
    # A twist or an elbow that cannot be told (a straight or hidden forearm) is held alone, and the upper arm still
    # mirrors; a swing that cannot be told leaves nothing to mirror.
    frozen_s = 0.0 if free[1] else state.frozen_s + elapsed_s
    lost = evidence.lost(target, inputs.evidence_age_s, free, config)
    if not lost and frozen_s > (config.resume_within_s if engaged else 0.0):
        lost = "The healthy arm's position is too uncertain."
    blockers = evidence.blockers(target, inputs, free, config)
    if not state.at_rest and not engaged:
        blockers = (*blockers, "The exoskeleton is still coming to rest.")
    facts = Facts(
        blockers,
        evidence.fault(inputs, engaged or state.gate.state is DriveState.HOLD),
        _silence(inputs, elapsed_s, config),
        lost,
        state.at_rest and evidence.near(target, inputs, free, config),
    )
    return replace(state, facts=facts, frozen_s=frozen_s, speed=free)


def _silence(inputs: SafetyInputs, elapsed_s: float, config: GateConfig) -> str:
    if inputs.interrupted:
        return inputs.interrupted
    if inputs.service_age_s > config.heartbeat_s:
        return "The service is silent; nobody could be heard."
    return f"The control loop stood still for {elapsed_s:.2f} s." if elapsed_s > config.stale_s else ""


def _begun(state: SafetyState, inputs: SafetyInputs, apart_rad: Joints, config: GateConfig) -> SafetyState:
    """The first set-point is where the arm is; the further the target, the longer the way there (SR-6)."""
    here = inputs.reading.angle_rad
    return replace(
        state,
        motions=tuple(Motion(angle) for angle in here),
        following=True,
        blend=0.0,
        blend_over_s=max(config.blend_s, max(apart_rad) / config.blend_rad_s),
        blend_from=here,
        thaw=ONE,
    )


def _follow(
    state: SafetyState,
    inputs: SafetyInputs,
    target: JointTarget,
    free: Joints,
    dt_s: float,
    config: GateConfig,
) -> tuple[SafetyState, DriveCommand]:
    blend = min(state.blend + dt_s / state.blend_over_s, 1.0)
    share = dt_s / config.blend_s
    thaw = tuple(min(thawed + share, 1.0) if speed else 0.0 for thawed, speed in zip(state.thaw, free, strict=True))
    speed = tuple(f * t for f, t in zip(free, thaw, strict=True))
    eased = blend * blend * (3 - 2 * blend)
    motions, clamped = [], []
    for i, (motion, box) in enumerate(zip(state.motions, inputs.boxes, strict=True)):
        goal = state.blend_from[i] + eased * (target.angle_rad[i] - state.blend_from[i])
        motions.append(towards(motion, goal, eased * target.velocity_rad_s[i], box, speed[i] * target.freedom[i], dt_s))
        clamped += _clamped(EXO_JOINTS[i], goal, free[i], box)
    state = replace(state, motions=tuple(motions), blend=blend, thaw=thaw, speed=speed)
    return state, _command(DriveMode.FOLLOW, state, "", tuple(clamped))


def _clamped(joint: str, goal_rad: float, free: float, box: Box) -> list[str]:
    words = []
    if not box.low_rad <= goal_rad <= box.high_rad:
        words.append(f"{joint}: at the end of its range")
    if free < 1.0:
        words.append(f"{joint}: {'slowed' if free else 'held'}, its target is uncertain or old")
    return words


def _rest(state: SafetyState, inputs: SafetyInputs, dt_s: float) -> tuple[SafetyState, DriveCommand]:
    """Come to rest at full deceleration, then hold; before anything was enabled, hold where the arm is."""
    if not state.at_rest:
        motions = tuple(to_rest(motion, box, dt_s) for motion, box in zip(state.motions, inputs.boxes, strict=True))
    elif state.gate.state in (DriveState.OFF, DriveState.READY) and not state.facts.fault:
        motions = tuple(map(_kept, state.motions, inputs.reading.angle_rad))
    else:
        motions = state.motions
    state = replace(state, motions=motions)
    return state, _command(DriveMode.HOLD if state.at_rest else DriveMode.FOLLOW, state, state.gate.reason, ())


def _kept(motion: Motion, measured_rad: float) -> Motion:
    """Where a joint is held; follows the arm only if somebody moves it, or its weight would pull it down bit by bit."""
    return Motion(measured_rad) if abs(measured_rad - motion.angle_rad) > MOVED_BY_HAND_RAD else motion


def _command(mode: DriveMode, state: SafetyState, reason: str, clamped: tuple[str, ...]) -> DriveCommand:
    return DriveCommand(
        mode,
        tuple(motion.angle_rad for motion in state.motions),
        tuple(motion.velocity_rad_s for motion in state.motions),
        reason,
        clamped,
    )
