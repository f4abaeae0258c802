"""`mirrorlimb evaluate`: how far every method and every single sensor is from the truth."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict
from math import isnan
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.progress import Progress, TaskID
from rich.table import Table

from fusion.errors import InputError
from fusion.estimation import METHODS
from fusion.evaluation.angle_scores import AngleScore
from fusion.evaluation.markdown import ANGLE_HEADINGS, ANGLE_LEGEND, HEADINGS, angle_cells, cells, page, title
from fusion.evaluation.runs import Evaluation, Way, evaluate_recording, pooled, pooled_angles, ways_of
from fusion.evaluation.scores import Score
from fusion.recording.reader import Recording, read_recording
from server.cli.orientation_scores import orientation_table, orientations_as_json, score_orientation
from server.cli.text_file import write_text

TABLE_WIDTH = 100
"""Figures are not cut off where the terminal is narrower, or none."""


def evaluate(
    recording: Annotated[list[Path], typer.Argument(help="Recordings with truth.", show_default=False)],
    method: Annotated[
        list[str] | None, typer.Option(help=f"One or more of {', '.join(METHODS)}. All by default.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print all figures as JSON instead of tables.")] = False,
    markdown: Annotated[Path | None, typer.Option(metavar="FILE", help="Write the tables as Markdown.")] = None,
) -> None:
    """Fuse recordings with every method and every sensor alone, and compare with their truth.

    Alignment and clock offsets are estimated: once from the whole recording, once on the way as live. Everything after
    the first two seconds is scored, occluded and lost frames too. Where a recording knows how an inertial sensor was
    turned, the orientation filter is judged by that.
    """
    recordings, more_methods = _told_apart(recording, bool(method))
    methods = _known([*(method or METHODS), *more_methods])
    sources = [read_recording(path) for path in recordings]
    turned = [score_orientation(s, s.orientation_truth) for s in sources if s.orientation_truth is not None]
    evaluations = _evaluated([s for s in sources if s.skeleton_streams or s.orientation_truth is None], methods)
    if as_json:
        told = _as_json(evaluations) | {"orientations": orientations_as_json(turned)}
        sys.stdout.write(json.dumps(told, indent=1) + "\n")
    else:
        console = Console(width=max(Console().width, TABLE_WIDTH))
        _show(console, evaluations)
        for score in turned:
            console.print(orientation_table(score))
    if markdown is not None:
        write_text(markdown, page(evaluations, _command(recordings, markdown)))


def _told_apart(words: Sequence[Path], after_method: bool) -> tuple[list[Path], list[str]]:
    """Recordings, and the further names of `--method NAME NAME`, which the command line hands us as recordings."""
    names = [str(word) for word in words if after_method and str(word) in METHODS and not word.exists()]
    return [word for word in words if str(word) not in names], names


def _command(recordings: Sequence[Path], markdown: Path) -> str:
    """What makes the page again, without this machine's folders."""
    page_name = markdown.name if markdown.is_absolute() else markdown.as_posix()
    return f"mirrorlimb evaluate {' '.join(path.name for path in recordings)} --markdown {page_name}"


def _known(methods: list[str]) -> list[str]:
    for name in methods:
        if name not in METHODS:
            raise InputError(f"no method is called '{name}'", f"one of {', '.join(METHODS)}", "mend --method")
    return list(dict.fromkeys(methods))


def _evaluated(recordings: Sequence[Recording], methods: Sequence[str]) -> list[Evaluation]:
    evaluations = []
    with Progress(console=Console(stderr=True), transient=True) as progress:
        for recording in recordings:
            advance = _advance(progress, progress.add_task(recording.name, total=1.0))
            evaluations.append(evaluate_recording(recording, ways_of(recording, methods), advance))
    return evaluations


def _advance(progress: Progress, bar: TaskID) -> Callable[[float], None]:
    return lambda share: progress.update(bar, completed=share)


def _show(console: Console, evaluations: Sequence[Evaluation]) -> None:
    """One recording: every joint of every run, then the healthy arm. Several: the healthy arm of each, then pooled."""
    for evaluation in evaluations:
        if len(evaluations) == 1:
            for run in evaluation.runs:
                heading = f"{evaluation.recording}: {run.way.name}\n{title(run.way.causal)}"
                console.print(_table(heading, "joint", run.joints.items()))
        _show_ways(console, evaluation.recording, [(run.way, run.healthy_arm) for run in evaluation.runs])
    together = evaluations[0].recording if len(evaluations) == 1 else f"{len(evaluations)} recordings together"
    if len(evaluations) > 1:
        _show_ways(console, together, list(pooled(evaluations).items()))
    if evaluations:
        _show_angles(console, together, pooled_angles(evaluations))


def _show_ways(console: Console, name: str, scores: Sequence[tuple[Way, Score]]) -> None:
    for causal in (False, True):
        rows = [(way.name, score) for way, score in scores if way.causal == causal]
        if rows:
            console.print(_table(f"{name}, healthy arm\n{title(causal)}", "method", rows))


def _show_angles(console: Console, name: str, by_way: dict[Way, dict[str, AngleScore]]) -> None:
    for way, scores in by_way.items():
        if scores and way.only_sensor is None:
            table = _empty(f"{name}, {way.name}: angles\n{title(way.causal)}", "angle", ANGLE_HEADINGS, ANGLE_LEGEND)
            for angle, score in scores.items():
                table.add_row(angle, *angle_cells(score))
            console.print(table)


def _table(heading: str, first: str, rows: Iterable[tuple[str, Score]]) -> Table:
    table = _empty(heading, first, HEADINGS, "mm; inside: share of instants within the reported bound")
    for name, score in rows:
        table.add_row(name, *cells(score))
    return table


def _empty(heading: str, first: str, columns: Sequence[str], caption: str) -> Table:
    table = Table(title=heading, caption=caption, box=SIMPLE_HEAD)
    table.add_column(first, no_wrap=True)
    for name in columns:
        table.add_column(name, justify="right", no_wrap=True)
    return table


def _as_json(evaluations: Sequence[Evaluation]) -> dict[str, Any]:
    angles = pooled_angles(evaluations)
    return {
        "recordings": [
            {
                "recording": evaluation.recording,
                "healthy_side": evaluation.healthy_side.value,
                "runs": [
                    {
                        **_way(run.way),
                        "joints": {name: asdict(score) for name, score in run.joints.items()},
                        "healthy_arm": asdict(run.healthy_arm),
                        "angles": _angles_as_json(run.angles),
                    }
                    for run in evaluation.runs
                ],
            }
            for evaluation in evaluations
        ],
        "pooled": [
            {**_way(way), "healthy_arm": asdict(score), "angles": _angles_as_json(angles[way])}
            for way, score in pooled(evaluations).items()
        ],
    }


def _angles_as_json(scores: dict[str, AngleScore]) -> dict[str, Any]:
    """Scores by row; a share of no instants is null."""
    return {name: _without_nan(asdict(score)) for name, score in scores.items()}


def _without_nan(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _without_nan(part) for key, part in value.items()}
    return None if isinstance(value, float) and isnan(value) else value


def _way(way: Way) -> dict[str, Any]:
    return {"name": way.name, "method": way.method, "causal": way.causal, "only_sensor": way.only_sensor}
