"""Pictures as PNG and SVG, tables as CSV, each experiment in a folder of its own."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path

from fusion.errors import MachineError
from fusion.experiments.outcome import Table
from fusion.experiments.output.made import Made, Origin
from fusion.experiments.output.page import page

PAGE = "index.html"


def write_all(made: Sequence[Made], origin: Origin, folder: Path) -> Path:
    """Write everything into `folder`, which is made if need be; returns the page.

    Raises:
        MachineError: the folder cannot be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for each in made:
            if each.outcome.tables or each.pictures:
                _write(each, folder / each.experiment.name)
        (folder / PAGE).write_text(page(made, origin), encoding="utf-8")
    except OSError as error:
        raise MachineError(
            f"cannot write into {folder}: {error.strerror}", "a folder that may be written", "name another with --out"
        ) from error
    return folder / PAGE


def _write(made: Made, folder: Path) -> None:
    folder.mkdir(exist_ok=True)
    for table in made.outcome.tables:
        _write_csv(table, folder / f"{table.name}.csv")
    for name, kinds in made.pictures.items():
        for kind, content in kinds.items():
            (folder / f"{name}.{kind}").write_bytes(content)


def _write_csv(table: Table, path: Path) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow([column.heading for column in table.columns])
        writer.writerows(table.rows)
