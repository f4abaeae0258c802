"""Ours: how far a session's figures from depth cameras lie from the same figures of the true motion."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.errors import RecordingError
from fusion.evaluation.scores import truth_at
from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.measures.agreement import FAITY, Agreement, Figures, agreements, due_trust
from fusion.experiments.measures.body_session import angles_rad, body_session, delayed
from fusion.experiments.measures.natural_rise import fitted_rise_m, rise_of
from fusion.experiments.outcome import Beside, Column, Outcome, Table, columns
from fusion.metrics.catalogue import MEASURES
from fusion.metrics.measure import Measure, Trust
from fusion.metrics.record import SessionRecord
from fusion.metrics.session import session_metrics
from fusion.offline import JOINING, fuse_recording
from fusion.recording.recording import Recording
from fusion.skeleton import Side, arm
from fusion.virtual_patient.trial import virtual_recording

TRUTHS: Final = "dual-kinect-truth-*"
ABILITIES: Final = (1.0, 0.8, 0.6, 0.5, 0.4, 0.3)
SLOW_S: Final = 45.0
COMPARED: Final = tuple(name for name, measure in MEASURES.items() if measure.trust_of_one is not None)
"""The figures that come from the cameras."""


def run(setup: Setup) -> Outcome:
    """Both cameras, each alone, and slow patients before two."""
    recordings = setup.recordings(TRUTHS)
    two, one = told_of(recordings, together=True), told_of(recordings, together=False)
    setup.progress(0.4)
    slow = told_of(_slow_patients(setup), together=True)
    of_two, of_one = words(two, together=True), words(one, together=False)
    return Outcome(
        (_beside("two cameras", of_two), _beside("one camera", of_one)),
        (
            _words_table(of_two, of_one),
            _table("two", "True motions before two cameras", two),
            _table("one", "The same, each camera alone", one),
            _table("slow", "Slow virtual patients before two cameras", slow),
            _rise_table(recordings),
        ),
        (),
        _WHY,
        (setup.seed,),
    )


def told_of(recordings: Iterable[Recording], *, together: bool) -> tuple[Agreement, ...]:
    """How far the figures of recordings lie from the truth's."""
    return agreements([pair for each in recordings for pair in sessions_of(each, together=together)])


@dataclass(frozen=True, slots=True)
class Word:
    """What the catalogue says of a measure beside what follows from the figures."""

    name: str
    said: Trust
    due: Trust


def words(told: Sequence[Agreement], *, together: bool) -> tuple[Word, ...]:
    """Of every measure that both speak of."""
    dues = {name: due for name in COMPARED if (due := due_trust(name, told)) is not None}
    return tuple(Word(name, _said(MEASURES[name], together), due) for name, due in dues.items())


def _said(measure: Measure, together: bool) -> Trust:
    return measure.trust if together or measure.trust_of_one is None else measure.trust_of_one


def sessions_of(recording: Recording, *, together: bool) -> Iterator[tuple[Figures, Figures]]:
    """Measured and true figures of a recording: of all its sensors together, or of each alone."""
    sensors = [None] if together else [stream.sensor for stream in recording.skeleton_streams]
    for sensor in sensors:
        told, true = _sessions(recording, sensor)
        yield _figures(told), _figures(true)


def _figures(session: SessionRecord) -> Figures:
    """Without the other arm's, which no camera has a part in."""
    other = session.healthy_side.other
    return tuple(one for one in session_metrics(session) if one.name in COMPARED and one.side is not other)


def _sessions(recording: Recording, sensor: str | None) -> tuple[SessionRecord, SessionRecord]:
    """As the sensors tell it, and as it was.

    Raises:
        RecordingError: there is no truth.
    """
    if recording.truth is None:
        raise RecordingError(f"recording '{recording.name}' has no truth", "a stream of kind 'truth'")
    fused = fuse_recording(recording, JOINING, only_sensor=sensor)
    side = recording.healthy_side or Side.RIGHT
    truth = truth_at(recording.truth, fused.t_s)
    known = np.isfinite(truth[:, list(arm(side)[:3])]).all(axis=(1, 2))
    t_s, true, told = fused.t_s[known], truth[known], fused.positions[known]
    affected = delayed(t_s, angles_rad(true, side))
    return body_session(t_s, told, affected, side), body_session(t_s, true, affected, side)


def _slow_patients(setup: Setup) -> Iterator[Recording]:
    for k, ability in enumerate(ABILITIES[: setup.many(len(ABILITIES), 1)]):
        yield virtual_recording(setup.seed + k, setup.long(SLOW_S), ability=ability)


def _beside(how: str, found: Sequence[Word]) -> Beside:
    follow = sum(word.said is word.due for word in found)
    what = f"words of trust in the catalogue that follow from the figures, {how}"
    return Beside(what, f"all {len(found)}", str(follow), follow == len(found))


def _words_table(two: Sequence[Word], one: Sequence[Word]) -> Table:
    alone = {word.name: word.due.value for word in one}
    rows = tuple((word.name, word.due.value, alone.get(word.name, "–")) for word in two)
    headings = (Column("figure"), Column("two cameras"), Column("one camera"))
    return Table("words", "The words of trust that follow", headings, rows)


def _table(name: str, caption: str, told: Sequence[Agreement]) -> Table:
    headings = (
        Column("figure"),
        Column("joint"),
        Column("unit"),
        Column("sessions"),
        Column("typical", 3),
        Column("bias", 3),
        Column("limits ±", 3),
    )
    rows = tuple((a.name, a.joint, a.unit, a.sessions, a.typical, a.bias, a.limit) for a in told)
    return Table(name, f"{caption}: measured minus true, 95 % limits of agreement about the bias", headings, rows)


def _rise_table(recordings: Sequence[Recording]) -> Table:
    """What raising the arm does to a shoulder that nobody hitches."""
    sessions = [(each.name, *_sessions(each, None)) for each in recordings]
    fitted_mm = 1e3 * fitted_rise_m([true for _, _, true in sessions])
    rises = [rise_of(name, told, true) for name, told, true in sessions]
    headings = ("recording", "elevation from [°]", "to [°]", "true range", "told, at most", "told as hitch, at most")
    rows = tuple(
        (
            one.recording,
            *np.degrees(one.elevation_rad).tolist(),
            *(1e3 * m for m in (one.true_m, one.told_m, one.left_m)),
        )
        for one in rises
    )
    caption = (
        f"The healthy shoulder's rise with its arm, nobody hitching, mm; fit over all: {fitted_mm:.1f} × (1 − cos)"
    )
    return Table("rise", caption, columns(*headings, digits=0), rows)


_WHY = (
    "Trust is what 95 % of sessions are within: 10 % of the typical figure (angles 10°, lengths 2 cm) is good, 25 % "
    f"(20°, 5 cm) fair, more is poor; never better than what is published ({FAITY}). The recordings are short and "
    "quick (typical peaks near 1.8 m/s). Below a measured 0.6 m/s the noise is as fast as the hand: one movement is "
    "told as several, and its peak is too high by half or more. A session that slow says so beside its figures."
)
EXPERIMENT = Experiment(
    "measures-trust",
    Chapter.OURS,
    "How far a session's figures can be trusted",
    "The words in the catalogue of measures (good, fair, poor) follow from the figures, by a rule that is said below.",
    "Every recording with truth is measured as if it were a session, once from the fused body and once from the true "
    "one, by the same program; with both cameras, then with each alone; then virtual patients who are slow.",
    run,
    needs=TRUTHS,
    order=6,
)
