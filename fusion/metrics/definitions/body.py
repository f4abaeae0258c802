"""Posture, the joints' ranges and how alike the arms moved."""

from __future__ import annotations

from fusion.metrics.measure import OURS, SRRR_2, Better, Measure, Trust

LEVIN = "Levin, Kleim, Wolf, Neurorehabil Neural Repair 23:313–319, 2009 (compensation)"
TRUNK = "of the way of SpineShoulder from where it was when the arm was enabled, while engaged"
HITCH = (
    "of the rise of the healthy shoulder along the spine since the arm was enabled, less 3 cm × (1 − cos elevation), "
    "which raising the arm brings with it, while engaged"
)
RANGE = "of the joint's angle about its circular mean, 50 valid ticks at least, while engaged"
STRETCHES = "50 Hz by linear interpolation in unbroken stretches"

POSTURE = (
    Measure(
        "trunk_displacement",
        "m",
        f"median {TRUNK}",
        f"{SRRR_2}; {LEVIN}",
        Trust.FAIR,
        "trust.trunk",
        Better.LESS,
        trust_of_one=Trust.FAIR,
        camera_error=0.0087,
    ),
    Measure(
        "trunk_displacement_p95",
        "m",
        f"95th percentile {TRUNK}",
        LEVIN,
        Trust.FAIR,
        "trust.trunk",
        Better.LESS,
        trust_of_one=Trust.FAIR,
        camera_error=0.013,
    ),
    Measure(
        "shoulder_hitch",
        "m",
        f"median {HITCH}",
        f"compensation: {LEVIN}; the formula is ours",
        Trust.FAIR,
        "trust.hitch",
        Better.LESS,
        "first-order low-pass, 0.3 s",
        trust_of_one=Trust.FAIR,
        camera_error=0.0046,
    ),
    Measure(
        "shoulder_hitch_p95",
        "m",
        f"95th percentile {HITCH}",
        f"compensation: {LEVIN}; the formula is ours",
        Trust.FAIR,
        "trust.hitch",
        Better.LESS,
        "first-order low-pass, 0.3 s",
        trust_of_one=Trust.FAIR,
        camera_error=0.0087,
    ),
)
RANGES = (
    Measure(
        "range_lowest",
        "rad",
        f"2nd percentile {RANGE}",
        OURS,
        Trust.FAIR,
        "trust.angles",
        trust_of_one=Trust.FAIR,
        camera_error=0.046,
    ),
    Measure(
        "range_highest",
        "rad",
        f"98th percentile {RANGE}",
        OURS,
        Trust.FAIR,
        "trust.angles",
        trust_of_one=Trust.POOR,
        camera_error=0.062,
    ),
    Measure(
        "range_of_movement",
        "rad",
        f"98th minus 2nd percentile {RANGE}",
        f"{SRRR_2}, as shoulder and elbow range; percentiles ours",
        Trust.FAIR,
        "trust.angles",
        Better.MORE,
        trust_of_one=Trust.POOR,
        camera_error=0.086,
    ),
)
BOTH_ARMS = (
    Measure(
        "symmetry",
        "1",
        "concordance 2 cov / (var + var + (difference of means)²) of healthy and affected angle at the best lag, per "
        "joint; 1 = the same movement. In mode passive it measures the drive",
        "Lin, Biometrics 45:255–268, 1989",
        Trust.GOOD,
        "trust.symmetry",
        Better.MORE,
        STRETCHES,
        trust_of_one=Trust.POOR,
        camera_error=0.0071,
    ),
    Measure(
        "lag",
        "s",
        "shift of the affected angle with the largest correlation, −0.2 to 1 s, parabola through the top",
        OURS,
        Trust.FAIR,
        "trust.symmetry",
        filter=STRETCHES,
        trust_of_one=Trust.POOR,
        camera_error=0.0077,
    ),
)
MEASURES = (*POSTURE, *RANGES, *BOTH_ARMS)
