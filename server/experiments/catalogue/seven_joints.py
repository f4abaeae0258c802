"""[Du2016, experiment 5]: a seven-joint arm follows the fused hand while either sensor is covered."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

import numpy as np

from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.outcome import NOT_GIVEN, Beside, Cell, Column, Outcome, Picture, Table, columns
from fusion.experiments.palette import FIRST_SHADE, OTHER, SECOND_SHADE, TRUTH, shade
from fusion.messages import Floats
from fusion.virtual_patient.sensor import TABLE1_CENTRED
from server.exoskeleton import BUILT_IN
from server.experiments.cranked.covering import (
    BOTH,
    CLEAR,
    FIRST,
    LEARN_S,
    SECOND,
    Progress,
    Run,
    hinders_start,
    recorded_run,
    virtual_run,
)
from server.experiments.cranked.judged import (
    Late,
    apart_m,
    arm_off_m,
    drive_work_s,
    engaged_share,
    fastest_rad_s,
    grown_m,
    hand_off_m,
    held_after_s,
    late,
    rms,
    steps_m,
)
from server.messages import EXO_JOINTS
from server.station.exo.simulated import SimulatedDrive

if TYPE_CHECKING:
    from matplotlib.figure import Figure

TRUTHS: Final = "dual-kinect-truth-*"
GOAL_MS: Final = 10.0
"""A good position drive is no further behind its command."""
HELD_MS: Final = 110.0
"""Three frames without a sensor (SR-4), and the tick that finds it out."""
ABRUPT_S: Final = 0.1
WORK_US: Final = 1000.0
"""A simulated drive may take a tenth of a tick's time."""
WORK_TICKS: Final = 500


def run(setup: Setup) -> Outcome:
    """Virtual patients with each lens covered in turn, and the recordings with truth, whose trouble is known."""
    seeds = tuple(setup.seed + k for k in range(setup.many(3)))
    recordings = setup.recordings(TRUTHS) if setup.has(TRUTHS) else ()
    parts = len(seeds) + len(recordings)

    def part(done: int) -> Progress:
        return lambda share: setup.progress((done + share) / parts)

    virtual = [virtual_run(seed, setup, part(k)) for k, seed in enumerate(seeds)]
    real = [recorded_run(one, part(len(seeds) + k)) for k, one in enumerate(recordings)]
    tables = [_phases_table("virtual", "Virtual patients", virtual), _joints_table("virtual", virtual)]
    pictures = [Picture("virtual", _VIRTUAL, lambda figure: _draw(figure, virtual[0]), height_in=5.4)]
    if real:
        tables += [_phases_table("recordings", "Real errors (recordings with truth)", real)]
        tables += [_joints_table("recordings", real), _each_table(real)]
        slowest = min(real, key=_fastest)
        pictures.append(Picture("recording", _RECORDED, lambda figure: _draw(figure, slowest), height_in=5.4))
    left_out = () if real else ("recordings with truth: none were given.",)
    hindered = hinders_start(setup.seed, TABLE1_CENTRED)
    blind = Beside("started with the errors of Table 1 for every joint", NOT_GIVEN, hindered or "yes")
    return Outcome((*_beside(virtual), blind), tuple(tables), tuple(pictures), _WHY, seeds, left_out)


# ---------------------------------------------------------------- figures


def _beside(runs: Sequence[Run]) -> tuple[Beside, ...]:
    engaged = min(_engaged(runs, FIRST), _engaged(runs, SECOND))
    hands = " / ".join(f"{1e3 * _hand(runs, phase):.0f}" for phase in (CLEAR, FIRST, SECOND))
    held_ms = [1e3 * held_after_s(one.course, one.phases[BOTH][0]) for one in runs]
    behind_ms = [1e3 * float(_drive(one).delay_s.max()) for one in runs]
    moved_mm = 1e3 * np.concatenate([_moved_m(one) for one in runs])
    abrupt_mm = 1e3 * max(_abrupt_m(one) for one in runs)
    work_us = 1e6 * drive_work_s(SimulatedDrive(BUILT_IN), WORK_TICKS)
    taken_nm = np.abs(np.concatenate([one.course.interaction_nm[one.course.following] for one in runs])).max(axis=1)
    resumed = sum(one.course.resumed_by_person for one in runs)
    return (
        Beside("engaged while one sensor is covered", "the arm follows", f"{100 * engaged:.0f} %", engaged == 1.0),
        Beside("hand off the mirrored truth, rms: clear / 1 / 2 covered", NOT_GIVEN, f"{hands} mm"),
        Beside("hand moved by the covering, median / p95", NOT_GIVEN, _two(moved_mm)),
        Beside("... within 0.1 s of covering or uncovering, at most", "no jump", f"{abrupt_mm:.0f} mm"),
        Beside("both covered: held after", f"{HELD_MS:.0f} ms", f"{max(held_ms):.0f} ms", max(held_ms) <= HELD_MS),
        Beside("... and a person had to go on", NOT_GIVEN, f"{resumed} of {len(runs)} times"),
        Beside(
            "drive behind its command",
            f"at most {GOAL_MS:.0f} ms",
            f"{max(behind_ms):.0f} ms",
            max(behind_ms) <= GOAL_MS,
        ),
        Beside("simulated drive's work per tick", f"below {WORK_US:.0f} µs", f"{work_us:.0f} µs", work_us < WORK_US),
        Beside("passive arm's own torque, as the drive tells it, p99 / most", NOT_GIVEN, _passive(taken_nm)),
    )


def _two(values: Floats) -> str:
    return f"{np.median(values):.0f} / {np.percentile(values, 95):.0f} mm"


def _passive(values_nm: Floats) -> str:
    return f"{np.percentile(values_nm, 99):.1f} / {values_nm.max():.1f} N m"


def _engaged(runs: Sequence[Run], phase: str) -> float:
    return float(np.nanmean([engaged_share(one.course, one.rows(phase)) for one in runs]))


def _hand(runs: Sequence[Run], phase: str) -> float:
    return rms(np.concatenate([arm_off_m(one.course)[one.rows(phase) & one.course.following] for one in runs]))


def _drive(one: Run) -> Late:
    return late(one.course.measured_rad, one.course.commanded_rad, one.judged, 0.1)


def _moved_m(one: Run) -> Floats:
    """How far the hand is from where it would be uncovered, while one sensor is covered."""
    rows = one.rows(FIRST) | one.rows(SECOND)
    return apart_m(one.course, one.uncovered or one.course)[rows & one.course.following]


def _abrupt_m(one: Run) -> float:
    """The most by which that distance grows within a tenth of a second of a lens being covered or uncovered."""
    apart = apart_m(one.course, one.uncovered or one.course)
    edges = [edge for phase in (FIRST, SECOND) for span in one.phases[phase] for edge in span]
    return max(grown_m(one.course.t_s, apart, edge, ABRUPT_S) for edge in edges)


def _phases_table(name: str, of: str, runs: Sequence[Run]) -> Table:
    rows = [_phase(runs, phase) for phase in (CLEAR, FIRST, SECOND, BOTH) if any(one.phases[phase] for one in runs)]
    heads = columns("engaged [%]", "sensors say [mm]", "motors [mm]", "arm [mm]", "arm, p95 [mm]", "largest step [mm]")
    caption = (
        f"{of}: the hand off the mirrored truth, rms while it follows: where the sensors say that it belongs, where "
        "the motors stand, where the arm in the exoskeleton is; and the most that this hand moves in 10 ms"
    )
    return Table(name, caption, (Column("phase"), *heads), tuple(rows))


def _phase(runs: Sequence[Run], phase: str) -> tuple[Cell, ...]:
    chosen = [(one.course, one.rows(phase) & one.course.following, one.rows(phase)) for one in runs]
    said = np.concatenate([hand_off_m(c, c.target_rad)[follows] for c, follows, _ in chosen])
    motors = np.concatenate([hand_off_m(c, c.measured_rad)[follows] for c, follows, _ in chosen])
    arm = np.concatenate([arm_off_m(c)[follows] for c, follows, _ in chosen])
    steps = np.concatenate([steps_m(c)[rows] for c, _, rows in chosen])
    p95 = float(np.nanpercentile(arm, 95)) if len(arm) else float("nan")
    figures = (rms(said), rms(motors), rms(arm), p95, float(steps.max()))
    return (phase, 100 * _engaged(runs, phase), *(1e3 * figure for figure in figures))


def _joints_table(name: str, runs: Sequence[Run]) -> Table:
    stages = [_stages(one) for one in runs]
    rows: tuple[tuple[Cell, ...], ...] = tuple(
        (
            joint,
            *(1e3 * _median([each[stage].delay_s[i] for each in stages]) for stage in range(4)),
            1e3 * _median([each[2].rms_rad[i] for each in stages]),
            _median([each[3].rms_rad[i] for each in stages]),
            _median([each[3].rms_shifted_rad[i] for each in stages]),
        )
        for i, joint in enumerate(EXO_JOINTS)
    )
    delays = columns("sensors [ms]", "calm and limits [ms]", "drive [ms]", "all [ms]", digits=0)
    heads = (Column("drive off [mrad]"), Column("all off [rad]", 3), Column("all off, less the delay [rad]", 3))
    caption = (
        "Joint by joint, median of the runs: how late the sensors' target is behind the mirrored truth, the command "
        "behind the target, the motors behind the command, the motors behind the truth; and how far off they are, rms. "
        "The plane counts little near a hanging arm, where it means little"
    )
    return Table(f"{name}-joints", caption, (Column("joint"), *delays, *heads), rows)


def _stages(one: Run) -> tuple[Late, Late, Late, Late]:
    """Truth to target, target to command, command to motors, truth to motors."""
    course, rows = one.course, one.judged
    return (
        late(course.target_rad, course.truth_rad, rows),
        late(course.commanded_rad, course.target_rad, rows),
        _drive(one),
        late(course.measured_rad, course.truth_rad, rows),
    )


def _median(values: Sequence[float]) -> float:
    return float(np.median(values))


def _each_table(runs: Sequence[Run]) -> Table:
    """Recording by recording: most of them move faster than an exoskeleton may."""
    rows: tuple[tuple[Cell, ...], ...] = tuple(
        (
            one.name,
            _fastest(one),
            100 * engaged_share(one.course, one.rows(FIRST) | one.rows(SECOND)),
            *(
                1e3 * rms(off[one.judged])
                for off in (hand_off_m(one.course, one.course.target_rad), arm_off_m(one.course))
            ),
        )
        for one in runs
    )
    heads = columns("fastest joint, p95 [rad/s]", "engaged in trouble [%]", "sensors say [mm]", "arm [mm]")
    caption = "Recording by recording; no joint of the exoskeleton may move faster than 2 rad/s"
    return Table("each-recording", caption, (Column("recording"), *heads), rows)


def _fastest(one: Run) -> float:
    return fastest_rad_s(one.course.truth_rad)


def _draw(figure: Figure, one: Run) -> None:
    course = one.course
    shades = ((FIRST, FIRST_SHADE), (SECOND, SECOND_SHADE), (BOTH, "#DDDDDD"))
    for axes, axis in zip(figure.subplots(3, 1, sharex=True), range(3), strict=True):
        for phase, colour in shades:
            shade(axes, one.phases[phase], colour, phase)
        axes.plot(course.t_s, 1e3 * course.truth_m[:, axis], color=TRUTH, lw=2.2, alpha=0.5, label="mirrored truth")
        axes.plot(course.t_s, 1e3 * course.arm_m[:, axis], color=OTHER, lw=1.2, label="arm in the exoskeleton")
        axes.set_ylabel(f"{('outward', 'up', 'back')[axis]} [mm]")
        if axis == 0:
            handles = axes.get_legend_handles_labels()
    figure.axes[0].set_xlim(LEARN_S, float(course.t_s[-1]))
    figure.axes[-1].set_xlabel("time [s]")
    figure.legend(*handles, loc="outside upper center", ncols=3)


_VIRTUAL = (
    "The knuckle of the arm in the exoskeleton, and where the mirrored truth has it. A covered sensor goes on telling "
    "a body whose arm wanders off; while both are covered the arm is held."
)
_RECORDED = "The same for a recording with truth, played over and over; the trouble was planted when it was made."
_WHY = (
    "The paper shows a seven-joint robot following while a Kinect is covered and gives no figure. Here the arm that "
    "follows is a human one in soft cuffs, so its hand is off for four reasons: the sensors' error, the calm and the "
    "limits of the movement, the drive, and the cuffs. The virtual patient is seen by good sensors: with the errors of "
    "Table 1 for every joint alone the bounds are so wide that the safety gate does not let the arm start. The people "
    "in the recordings move at 3 to 5 rad/s, which no exoskeleton may; there the arm comes late and cuts the corners, "
    "and only the column of what the sensors say tells of the fusion."
)
EXPERIMENT = Experiment(
    "seven-joints",
    Chapter.DU,
    "Experiment 5: a seven-joint arm follows while either sensor is covered",
    "A seven-joint robot follows the fused hand while either Kinect is covered in turn; pictures, no figure.",
    "Datagrams of two virtual sensors, or of recordings with real errors, go through decoder, pipeline, safety gate "
    "and simulated drive, ten milliseconds a tick, the clock turned by hand. Either lens is covered for seconds, then "
    "both for a moment, in which the arm must be held. The arm judged is the human one in the exoskeleton.",
    run,
    order=5,
)
