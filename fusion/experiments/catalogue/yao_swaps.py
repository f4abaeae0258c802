"""[Yao]'s exchange of left and right, on real walking: how often two sensors' shoulder lines are opposed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from fusion.align.opposed import Opposition, opposition
from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.outcome import NOT_GIVEN, Beside, Cell, Column, Outcome, Picture, Table, columns
from fusion.experiments.palette import FIRST, FUSED, SECOND
from fusion.recording.recording import Recording

if TYPE_CHECKING:
    from matplotlib.figure import Figure

STUDIES: Final = "dual-kinect-study??-*"
RIGHT_ANGLE: Final = "90deg"
GOAL_OPPOSED, GOAL_REFUSED = 0.01, 0.05
NAMES: Final = {"before": SECOND, "after mending": FUSED, "refused": FIRST}


def run(setup: Setup) -> Outcome:
    """Every study recording by itself; the right angles together."""
    found: dict[str, Opposition] = {}
    recordings = setup.recordings(STUDIES)
    for k, recording in enumerate(recordings):
        found[recording.name.removeprefix("dual-kinect-")] = _counted(recording)
        setup.progress((k + 1) / len(recordings))
    walked = {name: one for name, one in found.items() if one.pairs}
    at_right_angle = [one for name, one in walked.items() if name.endswith(RIGHT_ANGLE)]
    return Outcome(
        _beside(sum(at_right_angle[1:], at_right_angle[0])) if at_right_angle else (),
        (_table(found),),
        (Picture("opposed", _CAPTION, lambda figure: _draw(figure, walked), height_in=3.4),),
        _WHY,
    )


def _counted(recording: Recording) -> Opposition:
    streams = [stream for stream in recording.skeleton_streams if stream.samples]
    return opposition(streams, next(stream.sensor for stream in streams if stream.primary))


def _beside(found: Opposition) -> tuple[Beside, ...]:
    before, after, refused = found.shares
    return (
        Beside("shoulder lines opposed, walking at a right angle, as the sensors tell", NOT_GIVEN, f"{before:.1%}"),
        Beside("the same after mending", "under 1 %", f"{after:.2%}", after < GOAL_OPPOSED),
        Beside("frames refused for it", "at most 5 %", f"{refused:.2%}", refused <= GOAL_REFUSED),
    )


def _table(found: dict[str, Opposition]) -> Table:
    rows: tuple[tuple[Cell, ...], ...] = tuple(
        (name, one.pairs, *(100 * share for share in one.shares), one.frames_mended, one.frames_refused, one.frames)
        for name, one in found.items()
    )
    shares = columns("opposed before [%]", "opposed after [%]", "refused [%]", digits=2)
    counts = columns("frames mended", "frames refused", "frames in all")
    headings = (Column("recording"), Column("pairs, walking"), *shares, *counts)
    return Table("opposed", "Pairs of frames of both sensors while somebody walks; frames: all of them", headings, rows)


def _draw(figure: Figure, found: dict[str, Opposition]) -> None:
    axes = figure.subplots()
    for k, (name, colour) in enumerate(NAMES.items()):
        at = [number + (k - 1) * 0.27 for number in range(len(found))]
        axes.bar(at, [100 * one.shares[k] for one in found.values()], 0.25, color=colour, label=name)
    axes.set_xticks(range(len(found)), list(found), rotation=35, ha="right")
    axes.set_ylabel("pairs of frames [%]")
    axes.grid(visible=False, axis="x")
    axes.legend()


_CAPTION = "How often the two sensors' shoulder lines are opposed while somebody walks, before and after mending."
_WHY = (
    "The paper decides each frame by the facing that the joints themselves claim, and gives no count. A Kinect's own "
    "skeleton always claims to face it, so the facing here is a belief that goes on over time, fed by every sensor "
    "and by the direction of the walk."
)
EXPERIMENT = Experiment(
    "yao-swaps",
    Chapter.YAO,
    "Left and right exchanged",
    "A person whose back is turned to a Kinect has left and right exchanged by it, and a function puts them back; how "
    "often it is right is not given. Goal: opposed shoulder lines in under 1 % of walking frames at a right angle, at "
    "most 5 % refused.",
    "Real recordings of two Kinects and somebody who walks. Each frame of the first sensor is held against the "
    "nearest of the second: opposed where the lines from left to right shoulder point against each other in the "
    "horizontal. Before mending, after, and how many frames had their sided joints left out.",
    run,
    needs=STUDIES,
    order=3,
)
