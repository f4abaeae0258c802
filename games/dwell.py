"""How still a hand was where it had to stay."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from games.game import Point


def spread_m(places: Sequence[Point]) -> float | None:
    """Root mean square distance of the places (metres) from their mean; None for fewer than two."""
    if len(places) < 2:
        return None
    points = np.asarray(places)  # (N, 3)
    return float(np.sqrt(((points - points.mean(axis=0)) ** 2).sum(axis=1).mean()))
