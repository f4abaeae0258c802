"""A causal filter for a rig of tags: constant velocity, ranges taken as they come, those that do not fit dropped."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fusion.messages import Floats
from fusion.ranging.links import LinkModel
from fusion.ranging.pushes import Push
from fusion.ranging.rig import Rig, turn
from fusion.ranging.travel import TRAVELS_M_S

GATE: Final = 4.0
"""A range beyond so many deviations of its prediction is dropped: no line of sight, or a wrong echo."""
ACCELERATION_DENSITY: Final = 0.5
"""Of white acceleration, m²/s³; somebody who walks and turns."""
PUSHED_DENSITY: Final = 5e-4
"""The same where an inertial sensor tells the acceleration."""
OFFSET_DENSITY: Final = 3e-4
"""Of what the inertial sensor's own offset and tilt add to it, m²/s⁵."""
TURN_DENSITY: Final = 1.0
"""Of white angular acceleration, rad²/s³."""
HEADING_DENSITY: Final = 1e-5
"""Of cosine and sine of the inertial sensor's heading, 1/s: some degrees a minute."""
START_SPEED_M_S: Final = 1.0
START_TURN_RAD_S: Final = 1.0
START_SIGMA_M: Final = 0.5
START_YAW_RAD: Final = 0.5
START_HEADING: Final = 0.7
"""Of cosine and sine, where the heading may be any; √½ is what a circle has."""
START_OFFSET_M_S2: Final = 0.1


Trusted = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class RigState:
    """Mean and covariance of [p, v, yaw, yaw rate, c, s, offset]; D = 2 where the height is known, else 3.

    c and s, cosine and sine of its heading, take an inertial sensor's earth frame into the room: as two numbers, for
    then all is linear and the filter finds any heading from nothing. The offset (D,) m/s² is what the sensor measures
    too little, in the room. Without such a sensor they stay 0 and exact.
    """

    t_s: float
    mean: Floats  # (3 D + 4,)
    covariance: Floats  # (3 D + 4, 3 D + 4)
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
        return float(self.mean[2 * self.dimensions])

    @property
    def velocity(self) -> Floats:  # (D,) m/s
        """Of the rig's middle."""
        return self.mean[self.dimensions : 2 * self.dimensions]


def started(t_s: float, middle: Floats, yaw_rad: float, height_m: float | None) -> RigState:
    """A state at rest that knows little."""
    d = 3 if height_m is None else 2
    mean = np.concatenate([middle[:d], np.zeros(d), [yaw_rad, 0.0], np.zeros(2 + d)])
    deviations = [START_SIGMA_M] * d + [START_SPEED_M_S] * d + [START_YAW_RAD, START_TURN_RAD_S] + [0.0] * (2 + d)
    return RigState(t_s, mean, np.diag(np.square(deviations)), height_m)


def with_sensor(state: RigState, heading_rad: float | None) -> RigState:
    """A fresh state that an inertial sensor may push, whose heading is known or not."""
    d, mean = state.dimensions, state.mean.copy()
    if heading_rad is not None:
        mean[2 * d + 2 : 2 * d + 4] = np.cos(heading_rad), np.sin(heading_rad)
    heading = START_HEADING if heading_rad is None else 0.0
    deviations = [0.0] * (2 * d + 2) + [heading] * 2 + [START_OFFSET_M_S2] * d
    return replace(state, mean=mean, covariance=state.covariance + np.diag(np.square(deviations)))


def predicted(state: RigState, rig: Rig, t_s: float, push: Push | None = None) -> RigState:
    """F P F' + Q with white acceleration, Q = q [[dt³/3, dt²/2], [dt²/2, dt]] per axis; also for a real rig's yaw.

    With a push (Δv, Δs) of an inertial sensor v += R Δv + b dt and p += R Δs + ½ b dt², R of c and s and b the offset,
    and less is left to chance.
    """
    dt, d = t_s - state.t_s, state.dimensions
    step = np.eye(len(state.mean))
    noise = np.zeros_like(state.covariance)
    turning = TURN_DENSITY if rig.has_direction else 0.0
    walking = ACCELERATION_DENSITY if push is None else PUSHED_DENSITY
    for at, speed, density in [(i, d + i, walking) for i in range(d)] + [(2 * d, 2 * d + 1, turning)]:
        step[at, speed] = dt
        noise[at, at], noise[speed, speed] = density * dt**3 / 3, density * dt
        noise[at, speed] = noise[speed, at] = density * dt**2 / 2
    if push is not None:
        _enter_push(push, dt, d, step, noise)
    mean = step @ state.mean
    if push is not None and d == 3:
        mean[[2, 5]] += push.displacement_m[2], push.velocity_m_s[2]
    return replace(state, t_s=t_s, mean=mean, covariance=step @ state.covariance @ step.T + noise)


def _enter_push(push: Push, dt: float, d: int, step: Floats, noise: Floats) -> None:
    """The columns of c, s and the offset: x += c Δx − s Δy, y += c Δy + s Δx for displacement and velocity alike."""
    c, s, offset = 2 * d + 2, 2 * d + 3, 2 * d + 4 + np.arange(d)
    for first, (x, y, _) in ((0, push.displacement_m), (d, push.velocity_m_s)):
        step[first : first + 2, c], step[first : first + 2, s] = (x, y), (-y, x)
    step[np.arange(d), offset], step[d + np.arange(d), offset] = 0.5 * dt**2, dt
    noise[[c, s], [c, s]] = HEADING_DENSITY * dt
    noise[offset, offset] = OFFSET_DENSITY * dt


def updated(
    state: RigState, rig: Rig, links: LinkModel, anchors: Floats, range_m: Floats, since_s: Floats, trusted: Trusted
) -> tuple[RigState, Trusted]:
    """Take the ranges (A, K) of one instant that fit and are trusted; tells which fitted, (A, K).

    With u the unit vector from anchor to tag: ∂r/∂p = u, ∂r/∂yaw = u · (dR/dyaw) offset. All believed ranges at once in
    the form of information, P (1 + M P)⁻¹ with M = Σ h h' / R, which costs little however many links there are.
    """
    from_anchor = rig.positions(state.middle, state.yaw_rad) - anchors[:, None]  # (A, K, 3)
    distance = np.linalg.norm(from_anchor, axis=-1)
    bearing = np.arctan2(-from_anchor[..., 1], -from_anchor[..., 0]) - state.yaw_rad
    rows = _jacobian(state, rig, from_anchor / distance[..., None])  # (A, K, 3 D + 4)
    innovation = range_m - distance - links.expected_bias(bearing, distance)
    spread = np.sqrt(np.einsum("akm,mn,akn->ak", rows, state.covariance, rows) + links.sigma_m**2 + links.wander_m**2)
    fits = np.abs(innovation) < GATE * spread  # NaN compares false
    believed = fits & trusted
    if not believed.any():
        return state, fits
    h = rows[believed]
    weighted = h / links.variance_m2(since_s)[believed, None]
    covariance = state.covariance @ np.linalg.inv(np.eye(len(state.mean)) + weighted.T @ h @ state.covariance)
    mean = state.mean + covariance @ weighted.T @ innovation[believed]
    return replace(state, mean=mean, covariance=(covariance + covariance.T) / 2), fits


def _jacobian(state: RigState, rig: Rig, unit: Floats) -> Floats:
    d = state.dimensions
    rows = np.zeros((*unit.shape[:2], len(state.mean)))
    rows[..., :d] = unit[..., :d]
    rows[..., 2 * d] = np.einsum("akd,kd->ak", unit, _lever(state, rig))
    return rows


def _lever(state: RigState, rig: Rig) -> Floats:
    """(dR/dyaw) offset, (K, 3): how each tag moves as the rig turns."""
    return rig.offsets @ _turning(state.yaw_rad).T


def _turning(yaw_rad: float) -> Floats:
    """dR/dyaw, (3, 3)."""
    across = turn(yaw_rad + np.pi / 2)
    across[2, 2] = 0.0  # height does not change with the yaw
    return across


def pointed(state: RigState) -> RigState:
    """A lone tag points where it travels; while it hardly moves, where it pointed last."""
    vx, vy = state.velocity[:2]
    if np.hypot(vx, vy) < TRAVELS_M_S:
        return state
    mean = state.mean.copy()
    mean[2 * state.dimensions] = np.arctan2(vy, vx)
    return replace(state, mean=mean)


def tag_covariances(state: RigState, rig: Rig) -> Floats:
    """What the filter believes of each tag's position, (K, D, D) m²."""
    d = state.dimensions
    rows = np.zeros((len(rig.offsets), d, len(state.mean)))
    rows[:, :, :d] = np.eye(d)
    rows[:, :, 2 * d] = _lever(state, rig)[:, :d]
    return np.asarray(np.einsum("kim,mn,kjn->kij", rows, state.covariance, rows))
