"""[Du2016, Table 1]: the errors of one Kinect against Vicon, per axis and in range and angles."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from fusion.align.alignment import reference_alignment
from fusion.align.whole import align_streams
from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.measures.against_truth import sensor_errors
from fusion.experiments.measures.error_law import AXES, TABLE_1, UNITS, ErrorLaw, error_law
from fusion.experiments.outcome import Beside, Column, Outcome, Picture, Table
from fusion.experiments.palette import FIRST, PAPER, SECOND
from fusion.recording.recording import Recording
from fusion.virtual_patient.sensor import TABLE1
from fusion.virtual_patient.trial import virtual_recording

if TYPE_CHECKING:
    from matplotlib.figure import Figure

TRUTH: Final = "dual-kinect-truth-*"
LENGTH_S: Final = 60.0
SIMULATED, REAL = "simulated sensor", "real residuals"


def run(setup: Setup) -> Outcome:
    """Statistics of a simulated sensor, and of the sensors of the recordings with truth."""
    laws = {SIMULATED: simulated_law(setup)}
    left_out: tuple[str, ...] = ()
    if setup.has(TRUTH):
        laws[REAL] = real_law(setup.recordings(TRUTH))
    else:
        left_out = ("real residuals: no recordings with truth were given.",)
    return Outcome(
        tuple(_beside(name, law) for name, law in laws.items()),
        (_table(laws),),
        (Picture("errors-of-one-sensor", _CAPTION, lambda figure: _draw(figure, laws)),),
        _WHY,
        (setup.seed,),
        left_out,
    )


def simulated_law(setup: Setup) -> ErrorLaw:
    """What the simulation of Table 1 comes to when it is measured as the paper measured."""
    recording = virtual_recording(setup.seed, setup.long(LENGTH_S), noise=TABLE1, clock_offset_s=0.0)
    return error_law(*sensor_errors(recording, recording.skeleton_streams[0], reference_alignment()))


def real_law(recordings: tuple[Recording, ...]) -> ErrorLaw:
    """All sensors of all recordings together, each in its own frame."""
    said, true = [], []
    for recording in recordings:
        primary = next(stream.sensor for stream in recording.skeleton_streams if stream.primary)
        alignments = align_streams(recording.skeleton_streams, primary).alignments
        for stream in recording.skeleton_streams:
            measured, truth = sensor_errors(recording, stream, alignments[stream.sensor])
            said.append(measured)
            true.append(truth)
    return error_law(np.concatenate(said), np.concatenate(true))


def _beside(name: str, law: ErrorLaw) -> Beside:
    return Beside(
        f"one sensor's standard deviation in x, y, z ({name})",
        " / ".join(f"{std:.1f}" for std in TABLE_1.std[:3]) + " mm",
        " / ".join(f"{std:.1f}" for std in law.std[:3]) + " mm",
    )


def _table(laws: dict[str, ErrorLaw]) -> Table:
    everything = {"paper": TABLE_1} | laws
    figures = [law.mean for law in everything.values()] + [law.std for law in everything.values()]
    figures += [law.largest for law in everything.values()]
    headings = [Column("axis"), Column("unit")]
    headings += [Column(f"{what}, {name}", 2) for what in ("mean", "std", "largest") for name in everything]
    rows = tuple((AXES[k], UNITS[k], *(float(figure[k]) for figure in figures)) for k in range(len(AXES)))
    caption = "Errors of one sensor (the paper's largest error is its rounded interval)"
    return Table("table-1", caption, tuple(headings), rows)


def _draw(figure: Figure, laws: dict[str, ErrorLaw]) -> None:
    metres, angles = figure.subplots(1, 2, width_ratios=(2, 1))
    everything = {"paper": TABLE_1} | laws
    colours = {"paper": PAPER, SIMULATED: FIRST, REAL: SECOND}
    wide = 0.8 / len(everything)
    for axes, which, unit in ((metres, slice(0, 4), "mm"), (angles, slice(4, 6), "rad")):
        for k, (name, law) in enumerate(everything.items()):
            at = np.arange(len(law.std[which])) + (k - (len(everything) - 1) / 2) * wide
            axes.bar(at, law.std[which], wide * 0.92, color=colours[name], label=name)
        axes.set_xticks(range(len(AXES[which])), AXES[which])
        axes.set_ylabel(f"standard deviation [{unit}]")
        axes.grid(visible=False, axis="x")
    metres.legend()


_CAPTION = "Standard deviation of one sensor's error by axis: the paper's Table 1 and ours."
_WHY = (
    "The simulated sensor is built from Table 1, so its x, y and z return by construction, less what cutting at the "
    "interval takes away; its range and angles depend on where the patient sits. The paper's θ = asin(z/r) is singular "
    "for somebody straight in front of the lens, and φ turns about the optical axis, so both depend far more on the "
    "place of the person than on the sensor; the filter uses azimuth and elevation instead. The real residuals come "
    "from another study with other persons and distances; their systematic means were removed beforehand."
)
EXPERIMENT = Experiment(
    "du-table-1",
    Chapter.DU,
    "Table 1: the errors of one Kinect",
    "One Kinect against Vicon: mean, standard deviation and interval of a joint's error by axis, and in range and "
    "angles. The paper heads the second column 'variance (mm)'; in millimetres it can only be a standard deviation.",
    "The same statistics of a simulated sensor whose noise follows Table 1, one minute of arm exercises, and, where "
    "recordings with truth are given, of their sensors while they track the arm and no trouble was planted; shoulder, "
    "elbow and wrist of the healthy arm, each in its sensor's own frame.",
    run,
    order=2,
)
