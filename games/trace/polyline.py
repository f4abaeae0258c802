"""A line through space made of short straight pieces: where along it a hand is, and how far off."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.messages import Floats
from games.game import Point

SHORTEST_M: Final = 1e-9
"""What counts as no length."""


@dataclass(frozen=True, slots=True)
class Polyline:
    """Points joined by straight pieces; at least two points."""

    points: Floats
    """(n, 3) m."""
    reached_m: Floats
    """(n,) m from the beginning to each point, along the line."""

    @property
    def length_m(self) -> float:
        """From end to end along the line."""
        return float(self.reached_m[-1])

    @property
    def winding(self) -> float:
        """Its length over the straight way from end to end; 1 = straight, as is a line without length."""
        straight_m = float(np.linalg.norm(self.points[-1] - self.points[0]))
        return max(self.length_m / max(straight_m, SHORTEST_M), 1.0)

    def at(self, along_m: float) -> Point:
        """The point so far along the line; its ends beyond them."""
        x, y, z = (float(np.interp(along_m, self.reached_m, self.points[:, axis])) for axis in range(3))
        return x, y, z

    def nearest(self, place: Point, from_m: float, to_m: float) -> tuple[float, float]:
        """Where the part of the line between two lengths comes nearest to a place.

        Args:
            place: m.
            from_m: from here along the line, at most its length ...
            to_m: ... to here, not before it.

        Returns:
            How far along the line [m], and how far away from the place [m].
        """
        first, last = self._pieces(from_m, to_m)
        starts, begins_m = self.points[first:last], self.reached_m[first:last]  # (k, 3), (k,)
        steps = self.points[first + 1 : last + 1] - starts
        lengths_m = np.maximum(self.reached_m[first + 1 : last + 1] - begins_m, SHORTEST_M)
        foot_m = np.einsum("ij,ij->i", np.asarray(place) - starts, steps) / lengths_m
        low_m, high_m = np.maximum(from_m - begins_m, 0.0), np.minimum(to_m - begins_m, lengths_m)
        on_m = np.clip(foot_m, np.minimum(low_m, high_m), high_m)
        away_m = np.linalg.norm(starts + steps * (on_m / lengths_m)[:, None] - np.asarray(place), axis=1)
        k = int(np.argmin(away_m))
        return float(begins_m[k] + on_m[k]), float(away_m[k])

    def stays_until(self, place: Point, from_m: float, within_m: float) -> float:
        """How far along the line [m] every point of it, from `from_m` on, is within a distance of the place."""
        first = int(np.searchsorted(self.reached_m, from_m, "right"))
        beyond = np.linalg.norm(self.points[first:] - np.asarray(place), axis=1) > within_m
        last = first + (int(np.argmax(beyond)) if beyond.any() else len(beyond)) - 1
        return max(float(self.reached_m[last]), from_m)

    def _pieces(self, from_m: float, to_m: float) -> tuple[int, int]:
        """The first of the straight pieces between two lengths, and the one after the last."""
        first = min(max(int(np.searchsorted(self.reached_m, from_m, "right")) - 1, 0), len(self.points) - 2)
        return first, max(int(np.searchsorted(self.reached_m, to_m, "left")), first + 1)


def polyline(points: Floats) -> Polyline:
    """The line through (n, 3) points."""
    steps_m = np.linalg.norm(np.diff(points, axis=0), axis=1)
    return Polyline(points, np.concatenate(([0.0], np.cumsum(steps_m))))


def evenly(line: Polyline, length_m: float, spacing_m: float) -> Polyline:
    """The first `length_m` of a line, with points at about equal distances."""
    length_m = min(length_m, line.length_m)
    along_m = np.linspace(0.0, length_m, max(2, round(length_m / spacing_m) + 1))
    axes = [np.interp(along_m, line.reached_m, line.points[:, axis]) for axis in range(3)]
    return polyline(np.stack(axes, axis=1))


def rounded(corners: Floats, rounds: int) -> Floats:
    """Corners cut off again and again [Chaikin 1974]: it tends to a smooth curve (a quadratic B-spline).

    The curve begins and ends where the corners do and never leaves their convex hull.

    Args:
        corners: (n, d) any numbers.
        rounds: how often every corner is cut.
    """
    for _ in range(rounds):
        before, after = 0.75 * corners[:-1] + 0.25 * corners[1:], 0.25 * corners[:-1] + 0.75 * corners[1:]
        inner = np.stack([before, after], axis=1).reshape(-1, corners.shape[1])[1:-1]
        corners = np.concatenate([corners[:1], inner, corners[-1:]])
    return corners
