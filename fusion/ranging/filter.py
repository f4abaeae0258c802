"""A causal filter for a rig of tags: constant velocity, ranges taken as they come, those that do not fit dropped."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fusion.messages import Floats
from fusion.ranging.links import LinkModel
from fusion.ranging.rig import Rig, turn
from fusion.ranging.travel import TRAVELS_M_S

GATE: Final = 4.0
"""A range beyond so many deviations of its prediction is dropped: no line of sight, or a wrong echo."""
ACCELERATION_DENSITY: Final = 0.5
"""Of white acceleration, m²/s³; somebody who walks and turns."""
TURN_DENSITY: Final = 1.0
"""Of white angular acceleration, rad²/s³."""
START_SPEED_M_S: Final = 1.0
START_TURN_RAD_S: Final = 1.0
START_SIGMA_M: Final = 0.5
START_YAW_RAD: Final = 0.5


@dataclass(frozen=True, slots=True)
class RigState:
    """Mean and covariance of [p, v, yaw, yaw rate]; D = 2 where the height is known, else 3."""

    t_s: float
    mean: Floats  # (2 D + 2,)
    covariance: Floats  # (2 D + 2, 2 D + 2)
    height_m: float | None

    @property
    def dimensions(self) -> int:
        """D."""
        return 3 if self.height_m is None else 2

    @property
    def middle(self) -> Floats:  # (3,) m
        """The rig's middle in the room."""
        return self.mean[:3] if self.height_m is None else np.array([*self.mean[:2], self.height_m])

    @property
    def yaw_rad(self) -> float:
        """The rig's direction."""
        return float(self.mean[-2])


def started(t_s: float, middle: Floats, yaw_rad: float, height_m: float | None) -> RigState:
    """A state at rest that knows little."""
    d = 3 if height_m is None else 2
    mean = np.concatenate([middle[:d], np.zeros(d), [yaw_rad, 0.0]])
    deviations = [START_SIGMA_M] * d + [START_SPEED_M_S] * d + [START_YAW_RAD, START_TURN_RAD_S]
    return RigState(t_s, mean, np.diag(np.square(deviations)), height_m)


def predicted(state: RigState, rig: Rig, t_s: float) -> RigState:
    """F P F' + Q with white acceleration, Q = q [[dt³/3, dt²/2], [dt²/2, dt]] per axis; also for a real rig's yaw."""
    dt, d = t_s - state.t_s, state.dimensions
    step = np.eye(len(state.mean))
    noise = np.zeros_like(state.covariance)
    turning = TURN_DENSITY if rig.has_direction else 0.0
    axes = [(i, d + i, ACCELERATION_DENSITY) for i in range(d)] + [(2 * d, 2 * d + 1, turning)]
    for at, speed, density in axes:
        step[at, speed] = dt
        noise[at, at], noise[speed, speed] = density * dt**3 / 3, density * dt
        noise[at, speed] = noise[speed, at] = density * dt**2 / 2
    return replace(state, t_s=t_s, mean=step @ state.mean, covariance=step @ state.covariance @ step.T + noise)


def updated(
    state: RigState, rig: Rig, links: LinkModel, anchors: Floats, range_m: Floats, since_s: Floats
) -> tuple[RigState, NDArray[np.bool_]]:
    """Take the ranges (A, K) of one instant, so long after their links' last ones; tells which were believed, (A, K).

    With u the unit vector from anchor to tag: ∂r/∂p = u, ∂r/∂yaw = u · (dR/dyaw) offset. All believed ranges at once in
    the form of information, P⁻¹ + Σ h h' / R, which costs little however many links there are.
    """
    from_anchor = rig.positions(state.middle, state.yaw_rad) - anchors[:, None]  # (A, K, 3)
    distance = np.linalg.norm(from_anchor, axis=-1)
    bearing = np.arctan2(-from_anchor[..., 1], -from_anchor[..., 0]) - state.yaw_rad
    rows = _jacobian(state, rig, from_anchor / distance[..., None])  # (A, K, 2 D + 2)
    innovation = range_m - distance - links.expected_bias(bearing, distance)
    spread = np.sqrt(np.einsum("akm,mn,akn->ak", rows, state.covariance, rows) + links.sigma_m**2)
    believed = np.abs(innovation) < GATE * spread  # NaN compares false
    if not believed.any():
        return state, believed
    h = rows[believed]
    weighted = h / links.variance_m2(since_s)[believed, None]
    covariance = np.linalg.inv(np.linalg.inv(state.covariance) + weighted.T @ h)
    mean = state.mean + covariance @ weighted.T @ innovation[believed]
    return replace(state, mean=mean, covariance=(covariance + covariance.T) / 2), believed


def _jacobian(state: RigState, rig: Rig, unit: Floats) -> Floats:
    d = state.dimensions
    rows = np.zeros((*unit.shape[:2], len(state.mean)))
    rows[..., :d] = unit[..., :d]
    rows[..., 2 * d] = np.einsum("akd,kd->ak", unit, _lever(state, rig))
    return rows


def _lever(state: RigState, rig: Rig) -> Floats:
    """(dR/dyaw) offset, (K, 3): how each tag moves as the rig turns."""
    across = turn(state.yaw_rad + np.pi / 2)
    across[2, 2] = 0.0  # height does not change with the yaw
    return rig.offsets @ across.T


def pointed(state: RigState) -> RigState:
    """A lone tag points where it travels; while it hardly moves, where it pointed last."""
    d = state.dimensions
    vx, vy = state.mean[d : d + 2]
    if np.hypot(vx, vy) < TRAVELS_M_S:
        return state
    mean = state.mean.copy()
    mean[-2] = np.arctan2(vy, vx)
    return replace(state, mean=mean)


def tag_covariances(state: RigState, rig: Rig) -> Floats:
    """What the filter believes of each tag's position, (K, D, D) m²."""
    d = state.dimensions
    rows = np.zeros((len(rig.offsets), d, len(state.mean)))
    rows[:, :, :d] = np.eye(d)
    rows[:, :, 2 * d] = _lever(state, rig)[:, :d]
    return np.asarray(np.einsum("kim,mn,kjn->kij", rows, state.covariance, rows))
