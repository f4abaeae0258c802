"""`mirrorlimb evaluate`: how far every method and every single sensor is from the truth."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from fusion.errors import InputError, MachineError
from fusion.estimation import METHODS
from fusion.evaluation.markdown import HEADINGS, cells, page, title
from fusion.evaluation.runs import Evaluation, Way, evaluate_recording, pooled
from fusion.evaluation.scores import Score
from fusion.recording.reader import read_recording

STDOUT = "-"


def evaluate(
    recording: Annotated[list[Path], typer.Argument(help="Recordings with truth.", show_default=False)],
    method: Annotated[
        list[str] | None, typer.Option(help=f"One of {', '.join(METHODS)}; again for more. All by default.")
    ] = None,
    json_file: Annotated[
        str | None, typer.Option("--json", metavar="FILE", help="Write all figures as JSON; - for standard output.")
    ] = None,
    markdown: Annotated[Path | None, typer.Option(metavar="FILE", help="Write the tables as Markdown.")] = None,
) -> None:
    """Fuse recordings with every method and every sensor alone, and compare with their truth.

    Alignment and clock offsets are estimated: once from the whole recording, once on the way as live. Everything after
    the first two seconds is scored, occluded and lost frames too.
    """
    methods = _known(method or list(METHODS))
    evaluations = _evaluated(recording, methods)
    if json_file != STDOUT:
        _show(Console(), evaluations)
    if json_file is not None:
        _write(json_file, json.dumps(_as_json(evaluations), indent=1) + "\n")
    if markdown is not None:
        names = " ".join(path.name for path in recording)
        _write(str(markdown), page(evaluations, f"mirrorlimb evaluate {names} --markdown {markdown.name}"))


def _known(methods: list[str]) -> list[str]:
    for name in methods:
        if name not in METHODS:
            raise InputError(f"no method is called '{name}'", f"one of {', '.join(METHODS)}", "mend --method")
    return list(dict.fromkeys(methods))


def _evaluated(paths: Sequence[Path], methods: Sequence[str]) -> list[Evaluation]:
    evaluations = []
    with Progress(console=Console(stderr=True), transient=True) as progress:
        for path in paths:
            recording = read_recording(path)
            bar = progress.add_task(recording.name, total=1.0)
            evaluations.append(
                evaluate_recording(recording, methods, lambda share, bar=bar: progress.update(bar, completed=share))
            )
    return evaluations


def _show(console: Console, evaluations: Sequence[Evaluation]) -> None:
    for evaluation in evaluations:
        for run in evaluation.runs:
            heading = f"{evaluation.recording}: {run.way.name}"
            rows = [*run.joints.items(), ("healthy arm", run.healthy_arm)]
            console.print(_table(f"{heading}\n{title(run.way.causal)}", "joint", rows))
    for causal in (False, True):
        rows = [(way.name, score) for way, score in pooled(evaluations).items() if way.causal == causal]
        names = evaluations[0].recording if len(evaluations) == 1 else f"{len(evaluations)} recordings together"
        console.print(_table(f"Healthy arm, {names}\n{title(causal)}", "method", rows))


def _table(heading: str, first: str, rows: Sequence[tuple[str, Score]]) -> Table:
    table = Table(title=heading, caption="mm; inside: share of instants within the reported bound")
    table.add_column(first)
    for name in HEADINGS:
        table.add_column(name, justify="right")
    for name, score in rows:
        table.add_row(name, *cells(score), style="bold" if name == "healthy arm" else None)
    return table


def _as_json(evaluations: Sequence[Evaluation]) -> dict[str, Any]:
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
                    }
                    for run in evaluation.runs
                ],
            }
            for evaluation in evaluations
        ],
        "pooled": [{**_way(way), "healthy_arm": asdict(score)} for way, score in pooled(evaluations).items()],
    }


def _way(way: Way) -> dict[str, Any]:
    return {"name": way.name, "method": way.method, "causal": way.causal, "only_sensor": way.only_sensor}


def _write(name: str, text: str) -> None:
    if name == STDOUT:
        sys.stdout.write(text)
        return
    try:
        Path(name).write_text(text, encoding="utf-8")
    except OSError as error:
        raise MachineError(
            f"cannot write {name}: {error.strerror}", "a file in a folder that exists", "name another"
        ) from error
