"""The healthy hand's movements."""

from __future__ import annotations

from fusion.metrics.measure import ALT_MURPHY, HAND_FILTER, SCHWARZ, SRRR_2, Measure, Trust

MEASURES = (
    Measure(
        "movements",
        "1",
        "number of bells in the healthy hand's speed: a peak of 0.15 m/s or more that stands out by half its height, "
        "lasting 0.3 s and carrying the hand 8 cm or more",
        f"thresholds relative to the peak as usual ({SCHWARZ}); the values are ours",
        Trust.GOOD,
        "trust.movements",
        filter=HAND_FILTER,
        trust_of_one=Trust.FAIR,
    ),
    Measure(
        "movement_time",
        "s",
        "median over movements of the time from 15 % of the peak speed to 15 % of the peak speed",
        f"{SRRR_2}; {SCHWARZ}",
        Trust.GOOD,
        "trust.movement_time",
        filter=HAND_FILTER,
        trust_of_one=Trust.POOR,
        camera_error=0.036,
    ),
    Measure(
        "peak_speed",
        "m/s",
        "median over movements of the greatest speed",
        f"{SRRR_2}; {ALT_MURPHY}",
        Trust.POOR,
        "trust.peak_speed",
        filter=HAND_FILTER,
        trust_of_one=Trust.POOR,
        camera_error=0.057,
    ),
    Measure(
        "mean_speed",
        "m/s",
        "median over movements of path length divided by movement time",
        SCHWARZ,
        Trust.GOOD,
        "trust.mean_speed",
        filter=HAND_FILTER,
        trust_of_one=Trust.FAIR,
        camera_error=0.044,
    ),
    Measure(
        "path_ratio",
        "1",
        "median over movements of path length divided by the straight line from start to end; 1 = straight",
        f"{SRRR_2}; {SCHWARZ}",
        Trust.FAIR,
        "trust.path_ratio",
        filter=HAND_FILTER,
        trust_of_one=Trust.FAIR,
        camera_error=0.036,
    ),
    Measure(
        "sparc",
        "1",
        "median over movements of the spectral arc length of the speed: minus the length of the spectrum's curve up to "
        "10 Hz or to where it last reaches 5 % of its maximum; nearer to zero is smoother",
        "Balasubramanian et al., J NeuroEng Rehabil 12:112, 2015",
        Trust.FAIR,
        "trust.sparc",
        filter=HAND_FILTER,
        trust_of_one=Trust.FAIR,
        camera_error=0.053,
    ),
    Measure(
        "velocity_peaks",
        "1",
        "mean over movements of the number of peaks in the speed that rise 0.02 m/s or more and are 0.15 s or more "
        "apart; 1 = one smooth bell",
        ALT_MURPHY,
        Trust.POOR,
        "trust.velocity_peaks",
        filter=HAND_FILTER,
        trust_of_one=Trust.POOR,
        camera_error=0.26,
    ),
)
