"""Pictures as PNG and SVG, tables as CSV, each experiment in a folder of its own."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from fusion.errors import MachineError
from fusion.experiments.outcome import Table
from fusion.experiments.output.made import Made, Origin
from fusion.experiments.output.page import page

PAGE = "index.html"


def write_one(made: Made, folder: Path) -> None:
    """Write one experiment's pictures and tables into a folder of its name within `folder`; both are made if need be.

    Raises:
        MachineError: the folder cannot be written.
    """
    own = folder / made.experiment.name
    with _told_of(folder):
        folder.mkdir(parents=True, exist_ok=True)
        if made.outcome.tables or made.pictures:
            own.mkdir(exist_ok=True)
        for table in made.outcome.tables:
            _write_csv(table, own / f"{table.name}.csv")
        for name, kinds in made.pictures.items():
            for kind, content in kinds.items():
                (own / f"{name}.{kind}").write_bytes(content)


def write_page(made: Sequence[Made], origin: Origin, folder: Path) -> Path:
    """Write the page that holds everything; returns its place.

    Raises:
        MachineError: the folder cannot be written.
    """
    with _told_of(folder):
        (folder / PAGE).write_text(page(made, origin), encoding="utf-8")
    return folder / PAGE


@contextmanager
def _told_of(folder: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise MachineError(
            f"cannot write into {folder}: {error.strerror}", "a folder that may be written", "name another with --out"
        ) from error


def _write_csv(table: Table, path: Path) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow([column.heading for column in table.columns])
        writer.writerows(table.rows)
