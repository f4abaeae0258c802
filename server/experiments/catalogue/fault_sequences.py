"""Ours: a thousand sequences of random faults through the safety gate: is it safe in time, and inside its limits."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field
from math import nan, pi, sin
from random import Random
from typing import Final

import numpy as np

from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.outcome import Beside, Cell, Column, Outcome, Table, columns
from server.experiments.gate import wild
from server.experiments.gate.faults import FAULTS, LEANING, Fault, Moment
from server.experiments.gate.judge import JUDGED, excursions
from server.experiments.gate.plant import QuickArm
from server.experiments.gate.rig import TICK_S, GateRig, middle
from server.experiments.gate.watch import Watch
from server.messages import Assistance, DriveState, SetAssistance
from server.station.exo.driver import ZERO
from server.station.exo.mapping import JointTarget
from server.station.exo.measured import YIELDING_TOLERANCE_RAD

FREE: Final = Assistance.FREE
SEQUENCES: Final = 1_000
FAULTS_EACH: Final = 3
WARM_UP_S: Final = 1.2
RECOVERED_WITHIN_S: Final = 2.5
"""For so long a person tries to bring the gate back to engaged before the next fault comes."""


@dataclass(slots=True)
class Tally:
    """What happened."""

    ticks: int = 0
    outside: Counter[str] = field(default_factory=Counter)
    watched: dict[str, list[Watch]] = field(default_factory=lambda: defaultdict(list))
    """Per fault."""

    @property
    def all_watched(self) -> list[Watch]:
        """Of every fault."""
        return [watch for of_one in self.watched.values() for watch in of_one]


@dataclass(frozen=True, slots=True)
class Reaching:
    """The healthy arm's movement: each joint swings about the middle of its range, at most at its velocity limit."""

    middle_rad: tuple[float, ...]
    swing_rad: tuple[float, ...]
    turns_hz: tuple[float, ...]

    @classmethod
    def of(cls, source: Random, rig: GateRig) -> Reaching:
        """A random one; a little more than the range, sometimes."""
        swing = tuple(source.uniform(0.2, 0.55) * (joint.max_rad - joint.min_rad) for joint in rig.limits)
        quick = (source.uniform(0.3, 0.9) * joint.velocity_rad_s for joint in rig.limits)
        return cls(middle(rig.limits), swing, tuple(v / (2 * pi * s) for v, s in zip(quick, swing, strict=True)))

    def at(self, t_s: float) -> JointTarget:
        """The target then."""
        phases = [2 * pi * hz * t_s for hz in self.turns_hz]
        angle = tuple(m + s * sin(p) for m, s, p in zip(self.middle_rad, self.swing_rad, phases, strict=True))
        return wild.near_target(angle)


def run(setup: Setup) -> Outcome:
    """Every sequence with a patient, a device, faults and a seed of its own."""
    tally, many = Tally(), setup.many(SEQUENCES)
    for k in range(many):
        sequence(Random(f"{setup.seed}-{k}"), tally)  # noqa: S311 - chance, not secrecy
        setup.progress((k + 1) / many)
    return Outcome(_beside(tally, many), (_times_table(tally), _outside_table(tally)), (), _WHY, (setup.seed,))


def sequence(source: Random, tally: Tally) -> None:
    """One patient, engaged; some faults after one another, and a person who resumes in between."""
    limits = wild.limits(source)
    rig = GateRig(limits, wild.device(source), QuickArm(middle(limits)))
    reaching = Reaching.of(source, rig)
    _good(rig, reaching, tally)
    rig.wish(SetAssistance(number=1, mode=source.choice(list(Assistance)), level=source.random()))
    possible = [fault for fault in (*FAULTS, LEANING) if fault.concerns_free or rig.state.help.mode is not FREE]
    for _ in range(FAULTS_EACH):
        _recover(source, rig, reaching, tally)
        for _ in range(round(WARM_UP_S / TICK_S * source.uniform(0.5, 1.5))):
            _good(rig, reaching, tally)
        one_fault(source, rig, reaching, source.choice(possible), tally)


def _recover(source: Random, rig: GateRig, reaching: Reaching, tally: Tally) -> None:
    """A person who may not yet asks again."""
    for _ in range(round(RECOVERED_WITHIN_S / TICK_S)):
        if rig.now is DriveState.ENGAGED:
            return
        if source.random() < 0.1:
            wild.onward(rig)
        _good(rig, reaching, tally)


def _good(rig: GateRig, reaching: Reaching, tally: Tally) -> None:
    rig.tick(reaching.at(rig.t_s))
    _judge(rig, tally)


def one_fault(source: Random, rig: GateRig, reaching: Reaching, fault: Fault, tally: Tally) -> None:
    """One fault for its time, and somewhat more."""
    began_s, first = rig.t_s, rig.inputs.reading
    watch = Watch(fault, rig.now is DriveState.ENGAGED)
    lasts_s = min(fault.within_s, 2.0) + source.uniform(0.5, 1.5)
    while rig.t_s - began_s < lasts_s:
        moment = Moment(rig, rig.t_s - began_s + TICK_S, source, first, reaching.at(rig.t_s))
        fault.spoil(moment)
        rig.arm.push_nm = moment.push_nm
        rig.tick(moment.target, moment.seconds, moment.scene)
        _judge(rig, tally)
        watch.look(moment)
    rig.arm.push_nm = ZERO
    tally.watched[fault.name].append(watch)


def _judge(rig: GateRig, tally: Tally) -> None:
    tally.ticks += 1
    tally.outside.update(excursions(rig, YIELDING_TOLERANCE_RAD if rig.arm.was_pushed else 0.0))


def _beside(tally: Tally, sequences: int) -> tuple[Beside, ...]:
    outside, late = sum(tally.outside.values()), sum(watch.late for watch in tally.all_watched)
    many = sum(watch.engaged for watch in tally.all_watched)
    return (
        Beside(
            "random fault sequences: excursions of the simulated joint and of the command beyond their limits",
            "0 in a thousand sequences",
            f"{outside} in {sequences} ({tally.ticks} ticks)",
            outside == 0,
        ),
        Beside("faults while engaged after which the gate left it too late", "none", f"{late} of {many}", late == 0),
    )


def _times_table(tally: Tally) -> Table:
    rows = tuple(_times(fault, tally.watched[fault.name]) for fault in FAULTS)
    headings = (
        *(Column(name) for name in ("fault", "while engaged", "had to act")),
        *columns(
            "allowed [ms]", "to safe, median [ms]", "longest [ms]", "to rest, median [ms]", "longest to rest [ms]"
        ),
        Column("late"),
    )
    caption = (
        "From when a fault counts to the gate's having left engaged, and from then to the set-points' rest; a "
        "measurement that lies, and a drive that does not obey, count from when a joint is 0.2 rad from its command"
    )
    return Table("times", caption, headings, rows)


def _times(fault: Fault, watched: Sequence[Watch]) -> tuple[Cell, ...]:
    engaged = [watch for watch in watched if watch.engaged]
    safe, rest = ([1e3 * s for s in spans if s is not None] for spans in _spans(engaged))
    acted = len(safe)
    figures = [float(figure) for spans in (safe, rest) for figure in (_median(spans), max(spans, default=nan))]
    return (fault.name, len(engaged), acted, 1e3 * fault.within_s, *figures, sum(watch.late for watch in engaged))


def _spans(watched: Sequence[Watch]) -> tuple[list[float | None], list[float | None]]:
    return [watch.to_safe_s for watch in watched], [watch.to_rest_s for watch in watched]


def _median(spans: Sequence[float]) -> float:
    return float(np.median(spans)) if spans else nan


def _outside_table(tally: Tally) -> Table:
    rows = tuple((name, tally.outside[name]) for name in JUDGED)
    return Table("outside", "Ticks in which something was outside, of all", (Column("what"), Column("ticks")), rows)


_WHY = (
    "Where nobody pushes, a joint stays inside its range; where the patient pushes, with up to half of the "
    f"torque that the drive may use, it may lean {YIELDING_TOLERANCE_RAD} rad beyond it before that is a fault. A free "
    "arm is not led, so faults of the target do not concern it. A measurement that lies is left out there: from an arm "
    "that rests it cannot be told, and the drive does not move it."
)
EXPERIMENT = Experiment(
    "fault-sequences",
    Chapter.OURS,
    "A thousand random sequences of faults through the safety gate",
    "After any single fault the gate leaves engaged in time, and no joint leaves its limits (SR-1, SR-3, SR-4, SR-8, "
    "SR-11, SR-18).",
    "A thousand patients with random limits, devices and ways of being helped, each with three faults after one "
    "another while the healthy arm moves; a person resumes, resets and enables in between. Whether the gate leaves "
    "engaged in time is watched from when a fault counts, and every tick is judged as in 'commands'.",
    run,
    order=21,
    only_by_name=True,
)
