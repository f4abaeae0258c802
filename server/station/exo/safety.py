"""The safety gate: pure; a state and a tick's inputs in, the next state and the drive's command out."""

from __future__ import annotations

from dataclasses import replace

from server.config import GateConfig
from server.messages import Assistance, DriveState, OpenSession, SetAssistance, Wish
from server.station.exo import assistance, evidence, gate, measured, resistance, set_points, softness
from server.station.exo.assistance import Help
from server.station.exo.driver import JOINT_COUNT, ONE, ZERO, DriveCommand, DriveMode, DriveReading, Joints
from server.station.exo.evidence import SafetyInputs
from server.station.exo.gate import Facts, GateState
from server.station.exo.limiter import Motion
from server.station.exo.mapping import JointTarget
from server.station.exo.safety_state import SafetyState

SHORTEST_STEP_S = 1e-4
LONGEST_STEP_S = 0.02
"""A set-point never moves further than this much time allows, however late the tick."""
TOO_SOON = "The exoskeleton's state has only just changed; ask again."


def wish(state: SafetyState, wanted: Wish, now_s: float) -> tuple[SafetyState, str]:
    """Apply a person's wish at the tick's head; the second value says why it was refused ("" = granted).

    A granted wish outdates the facts: what comes in the same tick could be judged by another session's, or resume an
    arm that has not begun to brake.
    """
    after, refusal = gate.wish(state.gate, wanted, state.facts, now_s)
    refusal = refusal or _unhelpful(state, wanted)
    if refusal:
        return state, refusal
    facts = replace(state.facts, blockers=(*state.facts.blockers, TOO_SOON))
    return _as_chosen(replace(state, gate=after, facts=facts), wanted), ""


def _unhelpful(state: SafetyState, wanted: Wish) -> str:
    """Why the way of helping that a wish asks for cannot be."""
    can_comply = state.facts.can_comply
    if isinstance(wanted, OpenSession):
        return assistance.refused(wanted.assistance, wanted.level, can_comply)
    if not isinstance(wanted, SetAssistance):
        return ""
    begins_to_lead = wanted.mode is not state.help.mode and wanted.mode is not Assistance.FREE
    unled = state.facts.unled if begins_to_lead and state.gate.state is DriveState.ENGAGED else ()
    return assistance.refused(wanted.mode, wanted.level, can_comply) or " ".join(unled)


def _as_chosen(state: SafetyState, wanted: Wish) -> SafetyState:
    if isinstance(wanted, OpenSession):
        # Another patient: what the last one needed says nothing.
        return replace(state, help=assistance.chosen(Help(share=state.help.share), wanted.assistance, wanted.level))
    if not isinstance(wanted, SetAssistance):
        return state
    # An arm that the drive did not lead stiffly need not be where its set-point is: it is led from where it is.
    goes_on = wanted.mode is state.help.mode or min(state.help.share) >= 1.0
    return replace(
        state,
        help=assistance.chosen(state.help, wanted.mode, wanted.level),
        following=state.following and goes_on,
    )


def put_in(state: SafetyState, reading: DriveReading, now_s: float) -> SafetyState:
    """Somebody has put an arm in: what is held from now on is where it lies, not where the last one lay or yielded."""
    lies = measured.sound(reading, state.angle_rad, None, now_s, 0.0).angle_rad
    return replace(state, motions=tuple(map(Motion, lies)), seen_rad=None, yielded_at=None)


def step(
    state: SafetyState, inputs: SafetyInputs, config: GateConfig, now_s: float
) -> tuple[SafetyState, DriveCommand]:
    """One tick: judge, change state where that is due, move the set-points inside every limit."""
    elapsed_s = 0.0 if state.last_s is None else max(0.0, now_s - state.last_s)
    dt_s = min(max(elapsed_s, SHORTEST_STEP_S), LONGEST_STEP_S)
    raw, reading = inputs.reading, measured.sound(inputs.reading, state.angle_rad, state.seen_rad, now_s, elapsed_s)
    inputs = inputs if reading is raw else replace(inputs, reading=reading)
    target = evidence.usable(inputs.target)
    free = evidence.free_speed(target, inputs.evidence_age_s, config)
    state = _judged(state, inputs, target, free, elapsed_s, config)
    after = gate.watch(state.gate, state.facts, config, now_s)
    state = replace(
        state,
        gate=after,
        yielded_at=_yielded_at(state, after, inputs),
        seen_rad=measured.seen(raw, state.seen_rad),
        last_s=now_s,
    )
    if after.state is DriveState.ENGAGED and not state.facts.leads:
        return _moved(set_points.left_free(state, inputs), inputs, (), dt_s)
    if after.state is DriveState.ENGAGED and target is not None:
        state, clamped = set_points.led(state, inputs, target, free, dt_s, config)
        return _moved(state, inputs, clamped, dt_s)
    return _rest(state, inputs, dt_s)


# ---------------------------------------------------------------- judging


def _judged(
    state: SafetyState,
    inputs: SafetyInputs,
    target: JointTarget | None,
    free: Joints,
    elapsed_s: float,
    config: GateConfig,
) -> SafetyState:
    """The tick's facts, and what has to last to become one."""
    engaged = state.gate.state is DriveState.ENGAGED
    leads = _leads(state, inputs)
    # A twist or an elbow that cannot be told (a straight or hidden forearm) is held alone, and the upper arm still
    # mirrors; a swing that cannot be told leaves nothing to mirror.
    frozen_s = 0.0 if free[1] else state.frozen_s + elapsed_s
    lost = evidence.lost(target, inputs.evidence_age_s, free, config)
    if not lost and frozen_s > (config.resume_within_s if engaged else 0.0):
        lost = "The healthy arm's position is too uncertain."
    strained_s, astray_s = _strained(state, inputs, elapsed_s), _astray(state, inputs, elapsed_s)
    facts = Facts(
        blockers=_blockers(state, inputs),
        fault=_fault(state, inputs, astray_s),
        silence=_silence(inputs, elapsed_s, config),
        give_way=resistance.give_way(strained_s, inputs, state.help.share),
        lost=lost,
        far=evidence.far(target, inputs, free, config),
        leads=leads,
        can_comply=inputs.device.can_comply,
        near=state.at_rest and evidence.near(target, inputs, free, config),
    )
    return replace(state, facts=facts, frozen_s=frozen_s, speed=free, strained_s=strained_s, astray_s=astray_s)


def _strained(state: SafetyState, inputs: SafetyInputs, elapsed_s: float) -> Joints:
    """Whom the drive does not lead cannot resist it: a person leans on a wall."""
    if state.gate.state is DriveState.ENGAGED and not _leads(state, inputs):
        return ZERO
    return resistance.strained(state.strained_s, inputs, state.velocity_rad_s, elapsed_s)


def _astray(state: SafetyState, inputs: SafetyInputs, elapsed_s: float) -> Joints:
    return measured.astray(state.astray_s, inputs, state.angle_rad, state.help.share, elapsed_s)


def _leads(state: SafetyState, inputs: SafetyInputs) -> bool:
    return state.help.mode is not Assistance.FREE or not inputs.device.can_comply


def _fault(state: SafetyState, inputs: SafetyInputs, astray_s: Joints) -> str:
    """A waiting arm may be moved by hand; one that moves or is held is watched."""
    watched = state.gate.state in (DriveState.ENGAGED, DriveState.HOLD)
    return inputs.reading.fault or (measured.fault(inputs, astray_s, state.help.share) if watched else "")


def _blockers(state: SafetyState, inputs: SafetyInputs) -> tuple[str, ...]:
    """What forbids motion to begin, besides what may pass by itself, in plain words (SR-10)."""
    found = inputs.blockers or measured.outside_range(inputs)
    if not state.at_rest and state.gate.state is not DriveState.ENGAGED:
        return (*found, "The exoskeleton is still coming to rest.")
    return found


def _silence(inputs: SafetyInputs, elapsed_s: float, config: GateConfig) -> str:
    if inputs.interrupted:
        return inputs.interrupted
    if not inputs.service_age_s <= config.heartbeat_s:
        return "The service is silent; nobody could be heard."
    if not inputs.authority:
        return "Nobody who is in charge is connected."
    return f"The control loop stood still for {elapsed_s:.2f} s." if elapsed_s > config.stale_s else ""


def _yielded_at(state: SafetyState, after: GateState, inputs: SafetyInputs) -> Joints | None:
    """Where the arm is held that began to resist."""
    if not after.compliant:
        return None
    return inputs.reading.angle_rad if state.yielded_at is None else state.yielded_at


# ---------------------------------------------------------------- the command


def _rest(state: SafetyState, inputs: SafetyInputs, dt_s: float) -> tuple[SafetyState, DriveCommand]:
    state = set_points.rested(state, inputs, dt_s)
    soft = _soft(state, inputs)
    mode = DriveMode.HOLD if state.at_rest else DriveMode.FOLLOW
    return _commanded(mode, state, assistance.at_rest(state.help, soft, dt_s), soft, inputs, ())


def _soft(state: SafetyState, inputs: SafetyInputs) -> tuple[bool, ...]:
    """Which joints are held softly (SR-7, SR-18)."""
    if state.gate.compliant:
        return (True,) * JOINT_COUNT
    stopped = state.gate.state in (DriveState.STOPPED, DriveState.FAULT)
    return tuple(stopped and soft for soft in inputs.device.soft_stop)


def _moved(
    state: SafetyState, inputs: SafetyInputs, clamped: tuple[str, ...], dt_s: float
) -> tuple[SafetyState, DriveCommand]:
    error_rad = tuple(m - s for m, s in zip(inputs.reading.angle_rad, state.angle_rad, strict=True))
    helped = assistance.helped(state.help, error_rad, dt_s)
    return _commanded(DriveMode.FOLLOW, state, helped, (False,) * JOINT_COUNT, inputs, clamped)


def _commanded(
    mode: DriveMode,
    state: SafetyState,
    helped: Help,
    soft: tuple[bool, ...],
    inputs: SafetyInputs,
    clamped: tuple[str, ...],
) -> tuple[SafetyState, DriveCommand]:
    """The command; a drive that cannot comply is told nothing of softness, and is not given less than it needs."""
    walls = softness.wall(inputs)
    if not inputs.device.can_comply:
        helped, soft = replace(helped, share=ONE), (False,) * JOINT_COUNT
    share = tuple(map(max, helped.share, walls))
    state = replace(state, help=helped)
    reason, bound_nm = state.gate.reason, softness.torque_nm(inputs, soft, walls)
    return state, DriveCommand(mode, state.angle_rad, state.velocity_rad_s, reason, clamped, share, bound_nm)
