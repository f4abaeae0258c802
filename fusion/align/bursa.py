"""The mounting as [Du2016 §2.2] finds it: a turn by 90°, then the Bursa model by recursive least squares.

Kept as the paper's method, mended as docs/alignment.md says: the sign of the turn is found, the points are centred, and
the scale change m is held at 0 because both sensors measure in metres. It is linear in the angles, so ten degrees left
over cost about 38 mm at 2.5 m; the default, `fusion.align.space`, is exact at any angle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fusion.geometry import skew
from fusion.messages import Floats

QUARTER_TURN = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
"""Ry(90°) as printed."""
LOOSE = 1e6
"""Variance of the parameters before the first frame (m², rad²), in units of a joint's variance."""


@dataclass(frozen=True, slots=True)
class BursaState:
    """Parameters and covariance of the recursion; the covariance is in units of a joint's variance."""

    parameters: Floats  # (6,) Tx Ty Tz wx wy wz
    covariance: Floats  # (6, 6)


@dataclass(frozen=True, slots=True)
class BursaFit:
    """What the method says: ``p_reference = matrix p_sensor + translation``; the matrix is only nearly a rotation."""

    matrix: Floats  # (3, 3)
    translation_m: Floats  # (3,)

    def in_reference(self, positions_in_sensor: Floats) -> Floats:
        """Positions (..., 3) in the reference sensor's frame."""
        positions: Floats = positions_in_sensor @ self.matrix.T + self.translation_m
        return positions


def bursa(reference: Floats, sensor: Floats) -> BursaFit:
    """Fit the paper's model to paired joints.

    Args:
        reference: (N, J, 3) m, joints as the reference saw them; NaN where it did not.
        sensor: (N, J, 3) m, the same instants from the other sensor, about 90° to either side.

    Returns:
        The fit under whichever quarter turn leaves less.
    """
    fits = [_fit(reference, sensor, turn) for turn in (QUARTER_TURN, QUARTER_TURN.T)]
    return min(fits, key=lambda fit: float(np.nanmedian(np.linalg.norm(reference - fit.in_reference(sensor), axis=-1))))


def _fit(reference: Floats, sensor: Floats, turn: Floats) -> BursaFit:
    """P1' = P2 + H(P2) θ with P1' = turn · P1, both centred; solved back for P1."""
    both = np.asarray(np.isfinite(reference + sensor).all(axis=-1))
    ours, theirs = reference[both].mean(axis=0), sensor[both].mean(axis=0)
    state = BursaState(np.zeros(6), LOOSE * np.eye(6))
    for k in range(len(reference)):
        state = _take(state, (reference[k][both[k]] - ours) @ turn.T, sensor[k][both[k]] - theirs)
    shift, angles = state.parameters[:3], state.parameters[3:]
    matrix = turn.T @ (np.eye(3) - skew(angles))
    return BursaFit(matrix, ours + turn.T @ shift - matrix @ theirs)


def _take(state: BursaState, turned: Floats, sensor: Floats) -> BursaState:
    """Recursive least squares with one frame: turned = sensor + T + [sensor]× w."""
    if len(sensor) == 0:
        return state
    design = np.concatenate([np.tile(np.eye(3), (len(sensor), 1, 1)), skew(sensor)], axis=2).reshape(-1, 6)
    misfit = (turned - sensor).ravel() - design @ state.parameters
    innovation = design @ state.covariance @ design.T + np.eye(len(design))
    gain = np.linalg.solve(innovation, design @ state.covariance).T
    covariance = state.covariance - gain @ design @ state.covariance
    return BursaState(state.parameters + gain @ misfit, (covariance + covariance.T) / 2)
