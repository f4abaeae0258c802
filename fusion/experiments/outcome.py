"""What an experiment comes to: figures beside the paper's, tables, pictures, and why they differ."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:  # the figures' library is needed where they are drawn, and nowhere else
    from matplotlib.figure import Figure

NOT_GIVEN: Final = "not given"
"""Where the paper's text has lost the figure, or never had it."""
Cell = str | float | int
_WRITTEN: Final = re.compile(r"[-−]?\d[\d.,]*(e[-+]\d+)? ?%?|–")


@dataclass(frozen=True, slots=True)
class Column:
    """A table's column; the unit belongs into the heading."""

    heading: str
    digits: int = 1
    """Of fractions, where a person reads them; CSV keeps them all."""


@dataclass(frozen=True, slots=True)
class Table:
    """Rows under headings."""

    name: str
    """What its file is called."""
    caption: str
    columns: tuple[Column, ...]
    rows: tuple[tuple[Cell, ...], ...]
    folded: bool = False
    """A detail, shown only when asked for."""

    def as_text(self) -> list[list[str]]:
        """The cells as a person reads them."""
        return [[_text(cell, column) for cell, column in zip(row, self.columns, strict=True)] for row in self.rows]

    def is_number(self, column: int) -> bool:
        """Whether a column holds numbers, written out or not, which stand to the right."""
        return all(_is_number(row[column]) for row in self.rows)


@dataclass(frozen=True, slots=True)
class Picture:
    """A figure: drawn when it is needed, in the house style."""

    name: str
    caption: str
    draw: Callable[[Figure], None]
    width_in: float = 7.2
    height_in: float = 3.6


@dataclass(frozen=True, slots=True)
class Beside:
    """One figure of the paper, or one goal, beside ours."""

    what: str
    paper: str
    """With its unit; `NOT_GIVEN` where the text has lost it."""
    ours: str
    met: bool | None = None
    """Only where there is a goal to meet."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """Everything that one experiment has to say."""

    beside: tuple[Beside, ...] = ()
    tables: tuple[Table, ...] = ()
    pictures: tuple[Picture, ...] = ()
    why: str = ""
    """Why ours and the paper's differ, in plain words."""
    seeds: tuple[int, ...] = ()
    left_out: tuple[str, ...] = ()
    """Parts that could not be made, and why."""


def columns(*headings: str, digits: int = 1) -> tuple[Column, ...]:
    """Columns of equal precision."""
    return tuple(Column(heading, digits) for heading in headings)


def _is_number(cell: Cell) -> bool:
    return not isinstance(cell, str) or _WRITTEN.fullmatch(cell) is not None


def _text(cell: Cell, column: Column) -> str:
    if isinstance(cell, float):
        return "–" if cell != cell else f"{cell:.{column.digits}f}"
    return str(cell)
