"""Ours: a million random and hostile commands through the safety gate, and whether any leaves its limits."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from functools import partial
from math import inf, nan
from random import Random
from typing import Final

from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.outcome import Beside, Column, Outcome, Table, columns
from server.experiments.gate import wild
from server.experiments.gate.judge import JUDGED, excursions
from server.experiments.gate.plant import QuickArm
from server.experiments.gate.rig import IN_CHARGE, TICK_S, GateRig, Scene, middle, unspoilt
from server.messages import Assistance, DriveState, SetAssistance
from server.station.exo.mapping import JointTarget

EPISODES: Final = 500
COMMANDS: Final = 2_000
"""In one episode; each is a tick."""
CALM_TICKS: Final = 40
"""For so long a person waits for the arms to be near before asking to go on."""


@dataclass(slots=True)
class Tally:
    """What happened."""

    commands: int = 0
    outside: Counter[str] = field(default_factory=Counter)
    states: Counter[DriveState] = field(default_factory=Counter)
    helped: Counter[Assistance] = field(default_factory=Counter)
    """Ticks in engaged, by assistance."""
    closest_rad: float = inf
    """The least distance of a measured joint from the end of its range."""


def run(setup: Setup) -> Outcome:
    """Every episode with a patient, a device and a seed of its own."""
    tally, many = Tally(), setup.many(EPISODES)
    for k in range(many):
        episode(Random(f"{setup.seed}-{k}"), COMMANDS, tally)  # noqa: S311 - chance, not secrecy
        setup.progress((k + 1) / many)
    return Outcome(_beside(tally), (_outside_table(tally), _where_table(tally)), (), _WHY, (setup.seed,))


def episode(source: Random, commands: int, tally: Tally) -> None:
    """One patient in one device: every tick may bring another target, age, wish or broken measurement."""
    limits = wild.limits(source)
    rig = GateRig(limits, wild.device(source), QuickArm(middle(limits)))
    target: JointTarget | None = wild.near_target(rig.arm.angle_rad)
    rig.tick(target)
    rig.wish(SetAssistance(number=1, mode=source.choice(list(Assistance)), level=source.random()))
    calm = CALM_TICKS
    for _ in range(commands):
        calm -= 1
        if rig.now is not DriveState.ENGAGED and calm <= -CALM_TICKS:
            calm = CALM_TICKS
        if calm > 0:
            target = wild.near_target(rig.arm.angle_rad)
            if source.random() < 0.1 and rig.now is not DriveState.ENGAGED:
                wild.onward(rig)
            rig.tick(target)
        else:
            target = wild.target(source, rig) if source.random() < 0.2 else target
            _wild_tick(source, rig, target)
        _count(rig, tally)


def _wild_tick(source: Random, rig: GateRig, target: JointTarget | None) -> None:
    kind = source.random()
    if kind < 0.004:
        rig.wish(wild.wish(source))
    scene = Scene(
        evidence_age_s=source.choice((0.02, 0.08, 0.09, 0.2, inf, nan)) if source.random() < 0.02 else 0.0,
        service_age_s=source.choice((0.3, nan)) if kind > 0.9985 else 0.0,
        authority="" if 0.997 < kind < 0.9985 else IN_CHARGE,
        spoilt=partial(wild.spoilt_reading, source) if source.random() < 0.001 else unspoilt,
    )
    seconds = source.choice((0.0, 0.001, 0.03, 0.15)) if source.random() < 0.005 else TICK_S
    rig.tick(target, seconds, scene)


def _count(rig: GateRig, tally: Tally) -> None:
    tally.commands += 1
    tally.states[rig.now] += 1
    if rig.now is DriveState.ENGAGED:
        tally.helped[rig.state.help.mode] += 1
    tally.outside.update(excursions(rig))
    for angle, joint in zip(rig.arm.angle_rad, rig.limits, strict=True):
        tally.closest_rad = min(tally.closest_rad, angle - joint.min_rad, joint.max_rad - angle)


def _beside(tally: Tally) -> tuple[Beside, ...]:
    outside = sum(tally.outside.values())
    return (
        Beside(
            "random commands: excursions of the simulated joint and of the command beyond their limits",
            "0 of a million",
            f"{outside} of {tally.commands}",
            outside == 0,
        ),
        Beside(
            "closest that a measured joint came to the end of its range",
            "inside",
            f"{1e3 * tally.closest_rad:.1f} mrad",
        ),
    )


def _outside_table(tally: Tally) -> Table:
    rows = tuple((name, tally.outside[name]) for name in JUDGED)
    return Table("outside", "Ticks in which something was outside, of all", (Column("what"), Column("ticks")), rows)


def _where_table(tally: Tally) -> Table:
    rows = [(state.value, 100 * tally.states[state] / tally.commands) for state in DriveState]
    rows += [(f"engaged, {mode.value}", 100 * tally.helped[mode] / tally.commands) for mode in Assistance]
    return Table("where", "Where the gate was, of all ticks", (Column("state"), *columns("share [%]")), tuple(rows))


_WHY = (
    "The set-point's limits hold by the way it is moved: it goes only to where it can still brake. A set-point begins "
    "anew where the arm is measured, at engage and wherever the drive has been yielding; such a step is judged from "
    "there."
)
EXPERIMENT = Experiment(
    "commands",
    Chapter.OURS,
    "A million random commands through the safety gate",
    "No command, however wild, takes the command or the simulated joint out of its limits (SR-1, SR-2).",
    "500 patients with random limits in devices that can comply or not; every tick may bring another target (jumps, "
    "ends of the range, NaN, infinity, missing joints), another age of what is known, another wish, a late tick, or a "
    "broken measurement. Range of the measured joint, and range, velocity, acceleration, jerk and torque of every "
    "command, are judged in every tick. The joints are simulated with inertia, friction and unknown weight, without "
    "end stops.",
    run,
    order=20,
    only_by_name=True,
)
