"""How every figure looks, light and legible in print, and how it becomes bytes."""

from __future__ import annotations

from io import BytesIO
from typing import Any, Final

from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from fusion.experiments.outcome import Picture

DPI: Final = 160
_STYLE: Final[Any] = {
    "font.size": 9.5,
    "axes.titlesize": 10,
    "axes.titlelocation": "left",
    "axes.titleweight": "bold",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#E4E4E4",
    "grid.linewidth": 0.7,
    "lines.linewidth": 1.4,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "svg.hashsalt": "mirrorlimb",
}


def rendered(picture: Picture) -> dict[str, bytes]:
    """The picture as PNG and SVG, by the ending of the file's name; equal data give equal bytes."""
    with rc_context(_STYLE):
        figure = Figure(figsize=(picture.width_in, picture.height_in), layout="constrained")
        FigureCanvasAgg(figure)
        picture.draw(figure)
        return {kind: _saved(figure, kind) for kind in ("png", "svg")}


def _saved(figure: Figure, kind: str) -> bytes:
    buffer = BytesIO()
    metadata = {"Date": None} if kind == "svg" else None
    figure.savefig(buffer, format=kind, dpi=DPI, metadata=metadata)
    return buffer.getvalue()
