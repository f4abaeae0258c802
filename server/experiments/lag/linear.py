"""The best that any causal linear filter of 1.2 s could do, fitted to the truth of the same run."""

from __future__ import annotations

from typing import Final

import numpy as np

from fusion.messages import Floats
from server.experiments.cranked.station import DT_S
from server.experiments.lag.scores import SETTLED, delayed

TAPS: Final = 120
RIDGE: Final = 1e-7


def best_linear(
    seen_rad: Floats, truth_rad: Floats, delay: int, calm_s4: float = 0.0, punctual: bool = False
) -> Floats:
    """(T,) the output of the filter with the least mean square against the truth so many ticks ago (Wiener).

    Args:
        seen_rad: (T,) its input.
        truth_rad: (T,)
        delay: ticks.
        calm_s4: weight of the output's mean square acceleration beside that of its error.
        punctual: whether a steady angle must be kept in full and the best shift be the delay itself. Without it the
            best filter says less than it sees and comes later than it is judged: both are cheap where noise is large.
    """
    mean = float(truth_rad[SETTLED:].mean())
    inputs, wanted = _history(seen_rad - mean), delayed(truth_rad, delay) - mean
    inputs, wanted = inputs[SETTLED:], wanted[SETTLED:]
    bends = np.diff(inputs, 2, axis=0) / DT_S**2
    normal = inputs.T @ inputs + calm_s4 * (bends.T @ bends)
    normal += RIDGE * np.trace(inputs.T @ inputs) / TAPS * np.eye(TAPS)
    slope = inputs.T @ np.gradient(wanted)
    holds = np.array([np.ones(TAPS), slope / np.linalg.norm(slope)]) if punctual else np.empty((0, TAPS))
    weights = _constrained(normal, inputs.T @ wanted, holds, np.array([1.0, 0.0])[: len(holds)])
    found: Floats = _history(seen_rad - mean) @ weights + mean
    return found


def _history(seen: Floats) -> Floats:
    """(T, TAPS) the newest first."""
    padded = np.concatenate([np.full(TAPS - 1, seen[0]), seen])
    return np.lib.stride_tricks.sliding_window_view(padded, TAPS)[:, ::-1]


def _constrained(normal: Floats, moment: Floats, holds: Floats, values: Floats) -> Floats:
    """Minimise ½ w'Nw − m'w under H w = v, by Lagrange's multipliers."""
    many = len(holds)
    system = np.block([[normal, holds.T], [holds, np.zeros((many, many))]])
    found: Floats = np.linalg.solve(system, np.concatenate([moment, values]))[: len(moment)]
    return found
