"""Ours: help as much as is needed: how it fades while the patient tracks, and returns when the arm is kept back."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sin
from typing import TYPE_CHECKING, Final

import numpy as np

from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.outcome import Beside, Column, Outcome, Picture, Table, columns
from fusion.experiments.palette import FIRST, FUSED, SECOND
from fusion.messages import Floats
from server.config import StationConfig
from server.experiments.gate.rig import CONFIG, IN_CHARGE, TICK_S
from server.experiments.gate.wild import near_target
from server.messages import Assistance, DriveState, Enable, JointLimits, SetAssistance
from server.station.exo import safety
from server.station.exo.driver import Joints
from server.station.exo.evidence import SafetyInputs
from server.station.exo.gate import GateState
from server.station.exo.patient_range import boxes
from server.station.exo.safety_state import SafetyState
from server.station.exo.simulated import AT_REST, SimulatedDrive
from server.station.exo.softness import device_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

STATION: Final = StationConfig()
ELBOW: Final = 3
SWING_RAD, TURNS_HZ = 0.4, 0.25
STEPS_NM: Final = (0.0, -2.0, -4.0, 0.0)
"""Torque that keeps the elbow back, one after the other."""
STEP_S: Final = 20.0
SETTLED: Final = 0.5
"""The last share of each step is what counts."""


@dataclass(frozen=True, slots=True)
class Course:
    """One session, tick by tick."""

    t_s: Floats
    share: Floats
    """Of the drive's stiffness at the elbow."""
    error_rad: Floats
    """Measured less target, at the elbow."""
    engaged: bool
    """To the end."""


def run(setup: Setup) -> Outcome:
    """The same patient in every way of being helped."""
    step_s = setup.long(STEP_S, least_s=6.0)
    courses = {}
    for k, mode in enumerate(Assistance):
        courses[mode] = session(mode, step_s)
        setup.progress((k + 1) / len(Assistance))
    shares = [_settled(courses[Assistance.ASSISTED].share, n) for n in range(len(STEPS_NM))]
    rises = shares[0] < shares[1] < shares[2] and shares[3] < shares[2]
    said = " / ".join(f"{share:.2f}" for share in shares)
    return Outcome(
        (
            Beside(
                "share of the stiffness with the elbow kept back by 0 / 2 / 4 / 0 N m", "rises, and fades", said, rises
            ),
        ),
        (_table(courses),),
        (Picture("help", _HELP, lambda figure: _draw(figure, courses), height_in=4.0),),
        _WHY,
        (setup.seed,),
    )


def session(mode: Assistance, step_s: float) -> Course:
    """A patient whose elbow is kept back now and then, while the healthy arm swings."""
    many = round(len(STEPS_NM) * step_s / TICK_S)

    def effort(t_s: float, angle_rad: Joints) -> Joints:
        return (0.0, 0.0, 0.0, STEPS_NM[min(int(t_s / step_s), len(STEPS_NM) - 1)])

    drive = SimulatedDrive(STATION.exoskeleton, effort=effort)
    limits = STATION.device
    state = SafetyState(GateState(DriveState.READY, "", 0.0, session_open=True))
    state = safety.put_in(state, drive.read(0.0), 0.0)
    rows = []
    for k in range(many):
        t_s = (k + 1) * TICK_S
        wanted = (*AT_REST[:ELBOW], AT_REST[ELBOW] + SWING_RAD * sin(2 * pi * TURNS_HZ * t_s))
        state, command = safety.step(state, _inputs(drive, wanted, limits, t_s), CONFIG, t_s)
        drive.command(command, t_s)
        state = _begun(state, mode, k, t_s)
        rows.append((t_s, command.share[ELBOW], drive.read(t_s).angle_rad[ELBOW] - wanted[ELBOW]))
    t, share, error = np.array(rows).T
    return Course(t, share, error, state.gate.state is DriveState.ENGAGED)


def _inputs(drive: SimulatedDrive, wanted: Joints, limits: tuple[JointLimits, ...], t_s: float) -> SafetyInputs:
    return SafetyInputs(
        drive.read(t_s),
        near_target(wanted),
        0.0,
        0.0,
        limits,
        boxes(limits, CONFIG),
        authority=IN_CHARGE,
        device=device_of(STATION.exoskeleton, drive.can_comply),
    )


def _begun(state: SafetyState, mode: Assistance, tick: int, t_s: float) -> SafetyState:
    """A therapist chooses, and a tick later enables."""
    wishes = {1: SetAssistance(number=1, mode=mode, level=1.0), 3: Enable(number=2)}
    return safety.wish(state, wishes[tick], t_s)[0] if tick in wishes else state


def _settled(values: Floats, step: int) -> float:
    """Root mean square in the last part of a step."""
    parts = np.array_split(values, len(STEPS_NM))
    late = parts[step][round((1 - SETTLED) * len(parts[step])) :]
    return float(np.sqrt(np.mean(late**2)))


def _table(courses: dict[Assistance, Course]) -> Table:
    rows = tuple(
        (
            mode.value,
            nm,
            _settled(course.share, n),
            1e3 * _settled(course.error_rad, n),
            "yes" if course.engaged else "no",
        )
        for mode, course in courses.items()
        for n, nm in enumerate(STEPS_NM)
    )
    headings = (
        Column("assistance"),
        Column("kept back by [N m]"),
        *columns("share", digits=2),
        *columns("off the target, rms [mrad]", digits=0),
        Column("engaged to the end"),
    )
    return Table("help", "The elbow in the second half of each step", headings, rows)


def _draw(figure: Figure, courses: dict[Assistance, Course]) -> None:
    above, below = figure.subplots(2, 1, sharex=True)
    for (mode, course), colour in zip(courses.items(), (FIRST, FUSED, SECOND), strict=True):
        above.plot(course.t_s, course.share, color=colour, label=mode.value)
        below.plot(course.t_s, course.error_rad, color=colour)
    above.set_ylabel("share of stiffness")
    above.legend(ncols=3, loc="lower left", bbox_to_anchor=(0, 1))
    below.set_ylabel("off the target [rad]")
    below.set_xlabel("time [s]")


_HELP = "The elbow of the simulated arm; it is kept back by 2 N m in the second quarter and by 4 N m in the third."
_WHY = (
    "Passive is stiff and stays on the target whatever the arm does. Assisted gives as much as the error asks for and "
    "forgets it over two seconds; what is left of the error is what a soft drive leaves. Free only carries the weight."
)
EXPERIMENT = Experiment(
    "assistance",
    Chapter.OURS,
    "Help as much as is needed",
    "Help rises when the arm is kept back and fades when it no longer is.",
    "The simulated seven-joint exoskeleton with an arm in it whose elbow is kept back by 0, 2, 4 and 0 N m in turn, "
    "while the healthy elbow swings by 0.4 rad in four seconds, in each way of being helped. No muscle helps.",
    run,
    order=22,
)
