"""The colours of every figure: everybody can tell them apart [Okabe and Ito 2008]. And the shading of intervals."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TRUTH: Final = "#000000"
FIRST: Final = "#0072B2"
"""The first sensor."""
SECOND: Final = "#D55E00"
"""The second sensor."""
FUSED: Final = "#009E73"
PAPER: Final = "#8A8A8A"
OTHER: Final = "#CC79A7"
FIRST_SHADE: Final = "#CFE3F1"
SECOND_SHADE: Final = "#F8DCC8"
METHOD_COLOURS: Final = {
    "set-membership": FUSED,
    "kalman": OTHER,
    "esmf": "#56B4E9",
    "adaptive": "#E69F00",
    "average": PAPER,
}


def shade(axes: Axes, spans: Iterable[tuple[float, float]], colour: str, label: str) -> None:
    """Shade intervals of the horizontal axis; one entry in the legend for all of them."""
    for k, (start, end) in enumerate(spans):
        axes.axvspan(start, end, color=colour, lw=0, zorder=0, label=label if k == 0 else None)


def colour_of(method: str) -> str:
    """A method's colour in every figure."""
    return METHOD_COLOURS.get(method, OTHER)
