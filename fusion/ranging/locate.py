"""Where the tags are, instant by instant, with a bound: calibration, start, filter and restart put together."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fusion.errors import InputError
from fusion.messages import Floats
from fusion.ranging.calibration import Calibration
from fusion.ranging.filter import GATE, RigState, pointed, predicted, started, tag_covariances, updated, with_sensor
from fusion.ranging.links import LinkModel
from fusion.ranging.multilateration import solve_position
from fusion.ranging.pushes import Pushes
from fusion.ranging.ranges import Ranges
from fusion.ranging.rig import SINGLE, Rig

START_GATE_M: Final = 0.6
START_MEMORY_S: Final = 0.3
"""A start takes ranges that are no older: links are asked one after the other."""
PATIENCE_S: Final = 0.5
"""After so long without a range that fits, the filter is wrong, not the ranges: it starts again."""
PROBATION_S: Final = 0.3
"""A link whose range did not fit is not believed for so long: of the ranges that an obstacle lengthens by this much and
that, those that happen to fit are too long as well."""
RETRY_S: Final = 0.1
"""A start tries many sets of anchors; where none agrees, the next instant's ranges are nearly the same."""
SIGHT_MEMORY_S: Final = 1.0
BOUND_SIGMAS: Final = 3.5
FLAT: Final = 0.1
"""Anchors spread by less than so many metres along a direction say nothing of it."""


@dataclass(frozen=True, slots=True)
class Track:
    """The tags' positions on the truth's clock (the ranges' own where no lag was learnt)."""

    t_s: Floats  # (E,)
    positions: Floats  # (E, K, 3) m; NaN before the first fix
    bound_m: Floats  # (E, K) the truth is nearer than this, all but 1 % of the time
    anchors_used: NDArray[np.int64]  # (E, K) anchors whose range was believed at that instant


def require_solvable(anchors: Floats, height_m: float | None) -> None:
    """Refuse anchors that cannot tell where a tag is.

    Raises:
        InputError: too few, in one line, or in one plane with no height given.
    """
    least = 3 if height_m is not None else 4
    if len(anchors) < 3:
        raise InputError(f"{len(anchors)} anchors are too few", "at least three", "name more with --anchors")
    flat = anchors[:, : 2 if height_m is not None else 3]
    spread = np.linalg.svd(flat - flat.mean(axis=0), compute_uv=False)
    if height_m is None and (len(anchors) < least or spread[-1] < FLAT):
        remedy = "give the tag's height with --height"
        raise InputError("the anchors lie in one plane", "four or more that do not", remedy)
    if spread[-1] < FLAT:
        raise InputError("the anchors stand in one line", "three that make a triangle", "name others with --anchors")


def locate(
    ranges: Ranges,
    calibration: Calibration,
    height_m: float | None = None,
    progress: Callable[[float], None] = lambda share: None,
    inertial: Sequence[Pushes | None] | None = None,
) -> Track:
    """Locate every tag, causally.

    Args:
        ranges: of all tags to the anchors that may be used.
        calibration: what is known of the links; its rig joins the tags, without one each goes alone.
        height_m: of the tags, where the anchors lie in one plane.
        progress: told the share that is done.
        inertial: per tag the sensor that sits beside it, where there is one.

    Raises:
        InputError: the anchors cannot tell where a tag is.
    """
    require_solvable(ranges.anchors, height_m)
    tags = list(range(ranges.range_m.shape[2]))
    groups = [tags] if calibration.rig is not None else [[k] for k in tags]
    tracks = []
    for number, group in enumerate(groups):
        progress(number / len(groups))
        rig = calibration.rig or SINGLE
        beside = next((inertial[k] for k in group if inertial[k]), None) if inertial else None
        pushed = None if beside is None else replace(beside, t_s=beside.t_s - calibration.lag_s)  # the ranges' clock
        links = _of_tags(calibration.links, group)
        tracks.append(_Follower(ranges.of_tags(group), rig, links, height_m, pushed).track())
    stacked = [np.concatenate([getattr(t, name) for t in tracks], axis=1) for name in Track.__slots__[1:]]
    return Track(ranges.t_s + calibration.lag_s, stacked[0], stacked[1], stacked[2])


def _of_tags(links: LinkModel, tags: list[int]) -> LinkModel:
    return replace(links, bias_m=links.bias_m[:, tags], pattern_m=links.pattern_m[tags])


class _Follower:
    """Follows one rig; holds what one instant leaves to the next."""

    def __init__(
        self, ranges: Ranges, rig: Rig, links: LinkModel, height_m: float | None, pushes: Pushes | None
    ) -> None:
        self._ranges, self._rig, self._links = ranges, rig, links
        self._height_m = height_m if height_m is None else float(height_m - rig.offsets[:, 2].mean())
        self._pushes = pushes
        self._state: RigState | None = None
        self._last_fit_s = -np.inf
        self._tried_s = -np.inf
        self._seen_s = np.full(ranges.range_m.shape[1:], -np.inf)  # (A, K) when each link last gave a range
        self._refused_s = np.full(ranges.range_m.shape[1:], -np.inf)
        self._latest_m = np.full(ranges.range_m.shape[1:], np.nan)
        self._fitted_s = np.full(len(ranges.anchors), -np.inf)  # (A,) when each anchor was last believed

    def track(self) -> Track:
        """Every instant in turn."""
        instants, _, tags = self._ranges.range_m.shape
        positions, bound = np.full((instants, tags, 3), np.nan), np.full((instants, tags), np.nan)
        used = np.zeros((instants, tags), dtype=np.int64)
        for i, (t_s, range_m) in enumerate(zip(self._ranges.t_s.tolist(), self._ranges.range_m, strict=True)):
            used[i] = self._step(t_s, range_m).sum(axis=0)
            if self._state is not None:
                positions[i] = self._rig.positions(self._state.middle, self._state.yaw_rad)
                bound[i] = self._bound_m(self._state)
        return Track(self._ranges.t_s, positions, bound, used)

    def _step(self, t_s: float, range_m: Floats) -> NDArray[np.bool_]:
        """Take one instant's ranges; returns which were believed."""
        there = np.isfinite(range_m)
        since_s = t_s - self._seen_s
        self._seen_s[there], self._latest_m[there] = t_s, range_m[there]
        if t_s - self._tried_s >= RETRY_S and (t_s - self._last_fit_s > PATIENCE_S or self._is_outvoted(t_s)):
            self._tried_s = t_s
            self._state = self._start(t_s) or self._state
        if self._state is None:
            return np.zeros(range_m.shape, dtype=bool)
        push = None if self._pushes is None else self._pushes.between(self._state.t_s, t_s)
        state = predicted(self._state, self._rig, t_s, push)
        if not self._rig.has_direction:
            state = pointed(state)
        trusted = t_s - self._refused_s >= PROBATION_S
        self._state, fits = updated(state, self._rig, self._links, self._ranges.anchors, range_m, since_s, trusted)
        self._refused_s[there & ~fits] = t_s
        believed = fits & trusted
        if believed.any() or not there.any():
            self._last_fit_s = t_s
        self._fitted_s[believed.any(axis=1)] = t_s
        return believed

    def _is_outvoted(self, t_s: float) -> bool:
        """Whether most anchors in sight contradict the filter and agree with one another, with one more than needed."""
        seen = t_s - self._seen_s.max(axis=1) <= START_MEMORY_S
        least = 4 if self._height_m is not None else 5
        if seen.sum() < least or 2 * np.sum(t_s - self._fitted_s[seen] <= START_MEMORY_S) > seen.sum():
            return False
        links = self._links
        recent = np.where(seen[:, None], self._latest_m, np.nan) - links.bias_m
        gate_m = GATE * float(np.hypot(links.sigma_m, links.wander_m))
        fixes = [solve_position(self._ranges.anchors, column, gate_m, self._height_m) for column in recent.T]
        return all(fix is not None and fix.used.sum() >= max(least, seen.sum() - 1) for fix in fixes)

    def _start(self, t_s: float) -> RigState | None:
        """A state from the latest ranges alone, where enough tags can be solved."""
        recent = np.where(t_s - self._seen_s <= START_MEMORY_S, self._latest_m, np.nan) - self._links.bias_m
        fixes = [solve_position(self._ranges.anchors, column, START_GATE_M, self._height_m) for column in recent.T]
        tags = np.array([np.full(3, np.nan) if fix is None else fix.position for fix in fixes])
        if np.isfinite(tags).all(axis=1).sum() < (2 if self._rig.has_direction else 1):
            return None
        self._refused_s[:] = -np.inf
        state = started(t_s, *self._rig.pose(tags), self._height_m)
        return state if self._pushes is None else with_sensor(state, self._pushes.heading_rad)

    def _bound_m(self, state: RigState) -> Floats:
        """3.5 √tr(P + W): P what the filter believes; W what was never learnt of the links does, which no filter sees.

        W = w² (U'U + w²)⁻¹ with the unit vectors U from the anchors that fitted within the last second, one each:
        the tags of a rig are not taken to err independently.
        """
        sight = self._fitted_s >= state.t_s - SIGHT_MEMORY_S
        believed = np.trace(tag_covariances(state, self._rig), axis1=1, axis2=2)
        lasting = self._links.wander_m**2
        if not lasting:
            return np.asarray(BOUND_SIGMAS * np.sqrt(believed))
        away = (state.middle - self._ranges.anchors[sight])[:, : state.dimensions]
        unit = away / np.linalg.norm(state.middle - self._ranges.anchors[sight], axis=1)[:, None]
        wander = lasting * np.linalg.inv(unit.T @ unit + lasting * np.eye(state.dimensions))
        return np.asarray(BOUND_SIGMAS * np.sqrt(believed + np.trace(wander)))
