"""`mirrorlimb experiments`: the papers' tables and figures, made again."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path
from typing import Annotated

import typer
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table

from fusion.errors import InputError, MachineError
from fusion.experiments.experiment import Experiment, Setup
from fusion.experiments.output.files import write_one, write_page
from fusion.experiments.output.made import Made, Origin
from fusion.experiments.output.markdown import markdown as as_markdown
from fusion.experiments.registry import chosen
from fusion.experiments.registry import experiments as known
from fusion.experiments.shelf import Shelf
from server import __version__
from server.cli.loopback import Loopback
from server.cli.text_file import write_text
from server.experiments import catalogue

TABLE_WIDTH = 120
VERDICTS = {True: "met", False: "missed", None: ""}


def experiments(
    names: Annotated[
        list[str] | None, typer.Argument(metavar="[NAME]...", help="Which; all by default.", show_default=False)
    ] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="FOLDER", help="Where index.html, pictures and tables go.")
    ] = None,
    recordings: Annotated[
        Path | None, typer.Option(metavar="FOLDER", help="A folder of real recordings; some parts need them.")
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Of everything random.")] = 1,
    markdown: Annotated[Path | None, typer.Option(metavar="FILE", help="Write the tables as Markdown too.")] = None,
    effort: Annotated[
        float, typer.Option(help="Share of the usual lengths and repetitions, to try something out.")
    ] = 1.0,
    show_list: Annotated[bool, typer.Option("--list", help="Name the experiments and exit.")] = False,
) -> None:
    """Make the papers' tables and figures again, the papers' figures beside ours.

    Writes every figure as PNG and SVG, every table as CSV, and one page that holds them all.
    """
    picked = chosen(known(catalogue), names or ())
    if show_list:
        _list(picked)
        return
    if out is None:
        raise InputError("it is not said where to write", "a folder", "add --out FOLDER")
    if not 0 < effort <= 1:
        raise InputError(f"--effort is {effort:g}", "more than 0, at most 1")
    _need_matplotlib()
    setup = Setup(seed, effort, Shelf(recordings) if recordings else None, Loopback)
    origin = Origin(_command(names or [], recordings, markdown), seed, __version__, recordings is not None)
    _write(_made(picked, setup, out), origin, out, markdown)


def _list(picked: tuple[Experiment, ...]) -> None:
    table = Table(box=SIMPLE_HEAD)
    for heading in ("name", "what", "needs"):
        table.add_column(heading, no_wrap=heading != "what")
    for each in picked:
        table.add_row(each.name, each.title, each.needs or "")
    Console(width=max(Console().width, TABLE_WIDTH)).print(table)


def _need_matplotlib() -> None:
    if find_spec("matplotlib") is None:
        raise MachineError(
            "matplotlib, which draws the figures, is not installed",
            "the extra 'research'",
            ".venv/bin/python -m pip install -e '.[research]'",
        )


def _command(names: list[str], recordings: Path | None, markdown: Path | None) -> str:
    """What makes it again, without this machine's folders."""
    parts = ["mirrorlimb experiments", *names, "--out FOLDER"]
    if recordings is not None:
        parts.append("--recordings RECORDINGS")
    if markdown is not None:
        parts.append(f"--markdown {markdown.name if markdown.is_absolute() else markdown.as_posix()}")
    return " ".join(parts)


def _made(picked: tuple[Experiment, ...], setup: Setup, out: Path) -> list[Made]:
    """Make them while showing how far each is; each is written as soon as it is made."""
    from fusion.experiments.making import made  # draws: needs matplotlib, which is known to be there by now

    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    finished = []
    with Progress(*columns, console=Console(stderr=True)) as progress:
        bars = {each.name: progress.add_task(each.name, total=1.0, start=False) for each in picked}

        def watch(experiment: Experiment, share: float) -> None:
            bar = bars[experiment.name]
            progress.start_task(bar)
            progress.update(bar, completed=share)

        for each in made(picked, setup, watch):
            write_one(each, out)
            bar = bars[each.experiment.name]
            progress.update(bar, completed=1.0)
            progress.stop_task(bar)
            finished.append(each)
    return finished


def _write(finished: list[Made], origin: Origin, out: Path, markdown: Path | None) -> None:
    page = write_page(finished, origin, out)
    if markdown is not None:
        write_text(markdown, as_markdown(finished, origin))
    _summary(finished)
    console = Console(stderr=True, highlight=False, soft_wrap=True)
    for each in finished:
        for reason in each.outcome.left_out:
            console.print(f"{each.experiment.name}: left out: {reason}", markup=False)
    console.print(f"seed {origin.seed}, {sum(each.took_s for each in finished):.0f} s → {page}", markup=False)


def _summary(finished: list[Made]) -> None:
    table = Table(box=SIMPLE_HEAD)
    for heading in ("experiment", "what", "paper or goal", "ours", ""):
        table.add_column(heading)
    for each in finished:
        for row in each.outcome.beside:
            table.add_row(each.experiment.name, row.what, row.paper, row.ours, VERDICTS[row.met])
    Console(width=max(Console().width, TABLE_WIDTH)).print(table)
