"""How [Liu2017 §3–4] compare an inertial arm with optical positions: scale, a three-point frame, weighted translation.

Their equations 13–17 are lost but for the words around them. Restated: with the inertial points p and the optical
ones P, P ≈ K0 R p + T, where K0 is the ratio of the arm's lengths, R takes the frame of the inertial shoulder, elbow
and wrist at one instant into the optical frame of the same points, and T is the mean of P − K0 R p, weighted 0.6, 0.3
and 0.1 for shoulder, elbow and wrist. Nothing else is fitted.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.spatial.transform import Rotation

from fusion.geometry import Floats
from fusion.inertial.accuracy import track_simulated
from fusion.inertial.simulation import SensorErrors, simulate_arm

JOINTS: Final = ("shoulder", "elbow", "wrist")
WEIGHTS: Final = np.array([0.6, 0.3, 0.1])
OPTICAL_M: Final = np.array([0.4, 1.1, -0.3])
"""Where the shoulder is in the simulated optical frame; its axes are turned anyhow."""


@dataclass(frozen=True, slots=True)
class Placement:
    """P = K0 R p + T."""

    scale: float
    rotation: Floats  # (3, 3)
    translation_m: Floats  # (3,)

    def applied(self, points: Floats) -> Floats:
        """Points (..., 3) in the optical frame."""
        return self.scale * points @ self.rotation.T + self.translation_m


@dataclass(frozen=True, slots=True)
class Comparison:
    """An inertial arm in the optical frame beside the truth; J = shoulder, elbow, wrist."""

    t_s: Floats  # (T,)
    truth: Floats  # (T, 3, 3) m
    found: Floats  # (T, 3, 3) m
    placement: Placement
    correlation: Floats  # (3,) mean over the axes of Pearson's coefficient; NaN for a joint that does not move

    @property
    def error_m(self) -> Floats:  # (T, 3, 3) joint, axis
        """What was found less the truth."""
        return self.found - self.truth

    @property
    def rms_m(self) -> Floats:  # (3,)
        """Root mean square distance of each joint from the truth."""
        return np.asarray(np.sqrt(np.mean(np.sum(self.error_m**2, axis=-1), axis=0)))


def compare_like_liu(seed: int, errors: SensorErrors | None = None, duration_s: float = 60.0) -> Comparison:
    """A simulated arm, followed by its inertial sensors and compared as the paper does; the same for the same seed.

    The shoulder is the origin of both chains and does not move, so it has an error (through T) and no correlation.

    Args:
        seed: of the movement, the sensors' places and their errors.
        errors: the sensors'; by default those that the sensor of BROAD shows.
        duration_s: of the movement.
    """
    arm = simulate_arm(seed, duration_s, errors=errors)
    turned = Rotation.random(rng=np.random.default_rng([seed, 7])).as_matrix()
    truth = arm.positions[:, :3] @ turned.T + OPTICAL_M
    inertial = track_simulated(arm).positions[:, :3]
    placed = place(inertial, truth)
    found = placed.applied(inertial)
    return Comparison(arm.t_s, truth, found, placed, _correlations(found, truth))


def place(inertial: Floats, optical: Floats) -> Placement:
    """The placement by the paper's recipe, from positions (T, 3, 3) of shoulder, elbow and wrist.

    The instant for the frames, which the paper does not name, is where the inertial elbow is nearest to a right angle.
    """
    scale = float(_length_m(optical) / _length_m(inertial))
    upper, fore = (inertial[:, k + 1] - inertial[:, k] for k in (0, 1))
    bend = np.abs(np.sum(upper * fore, axis=1)) / (np.linalg.norm(upper, axis=1) * np.linalg.norm(fore, axis=1))
    at = int(bend.argmin())
    rotation = three_point_frame(optical[at]) @ three_point_frame(inertial[at]).T
    left = (optical - scale * inertial @ rotation.T).mean(axis=0)  # (3, 3) joint, axis
    return Placement(scale, rotation, WEIGHTS @ left)


def three_point_frame(points: Floats) -> Floats:
    """Axes as columns, (3, 3): x from the first of (3, 3) points to the second, z across all three, y = z × x."""
    x = points[1] - points[0]
    x = x / np.linalg.norm(x)
    z = np.cross(x, points[2] - points[0])
    z = z / np.linalg.norm(z)
    return np.stack([x, np.cross(z, x), z], axis=-1)


def _length_m(points: Floats) -> float:
    return float(np.linalg.norm(np.diff(points, axis=1), axis=-1).sum(axis=1).mean())


def _correlations(found: Floats, truth: Floats) -> Floats:
    moves = np.ptp(truth, axis=0).max(axis=-1) > 1e-6
    each = [_correlation(found[:, j], truth[:, j]) if moves[j] else np.nan for j in range(len(JOINTS))]
    return np.array(each)


def _correlation(found: Floats, truth: Floats) -> float:
    return float(np.mean([np.corrcoef(found[:, axis], truth[:, axis])[0, 1] for axis in range(3)]))
