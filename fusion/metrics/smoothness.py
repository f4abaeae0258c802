"""How smooth a movement is: spectral arc length (SPARC) and log dimensionless jerk (LDLJ)."""

from __future__ import annotations

from math import ceil, log, log2
from typing import Final

import numpy as np

from fusion.messages import Floats

PAD_LEVEL: Final = 4
CUT_OFF_HZ: Final = 10.0
AMPLITUDE_THRESHOLD: Final = 0.05


def sparc(speed: Floats, rate_hz: float, cut_off_hz: float = CUT_OFF_HZ) -> float:
    """Spectral arc length of a speed profile; nearer to zero is smoother, a minimum-jerk reach gives about −1.4.

    With the zero-padded magnitude spectrum V̂(ω) of the speed, scaled to a largest value of 1,
    SPARC = −∫₀^ω_c √((1/ω_c)² + (dV̂/dω)²) dω, where ω_c is the last frequency below `cut_off_hz` at which V̂ reaches
    0.05. Source: Balasubramanian, Melendez-Calderon, Roby-Brami, Burdet, "On the analysis of movement smoothness",
    JNER 12:112 (2015); threshold 0.05 and padding level 4 as in the authors' program.

    Args:
        speed: (N,) non-negative, any unit, evenly sampled; N ≥ 2 and not all zero.
        rate_hz: sampling rate.
        cut_off_hz: highest frequency looked at.
    """
    size = 2 ** (ceil(log2(len(speed))) + PAD_LEVEL)
    frequency = np.arange(size) * (rate_hz / size)
    spectrum = np.abs(np.fft.fft(speed, size))
    spectrum /= spectrum.max()
    strong = np.flatnonzero((frequency <= cut_off_hz) & (spectrum >= AMPLITUDE_THRESHOLD))
    chosen = slice(strong[0], strong[-1] + 1)
    steps = np.diff(frequency[chosen]) / (frequency[chosen][-1] - frequency[chosen][0])
    return -float(np.hypot(steps, np.diff(spectrum[chosen])).sum())


def dimensionless_jerk(velocity: Floats, rate_hz: float) -> float:
    """DLJ = −(D³ / v_peak²) ∫|jerk|² dt; always negative, nearer to zero is smoother (same source, equation 9).

    Args:
        velocity: (N, 3) or (N,), evenly sampled, N ≥ 3 and not all zero. Unfiltered depth-camera velocities give values
            that cannot be compared with an optical system's.
        rate_hz: sampling rate.
    """
    samples = velocity.reshape(len(velocity), -1)  # (N, D)
    duration_s = len(samples) / rate_hz
    peak = float(np.linalg.norm(samples, axis=1).max())
    jerk = np.diff(samples, 2, axis=0) * rate_hz**2
    return -(duration_s**3 / peak**2) * float((jerk**2).sum()) / rate_hz


def log_dimensionless_jerk(velocity: Floats, rate_hz: float) -> float:
    """LDLJ = −ln|DLJ|; see `dimensionless_jerk`."""
    return -log(-dimensionless_jerk(velocity, rate_hz))
