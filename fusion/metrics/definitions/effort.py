"""What the affected arm did itself, and how much the exoskeleton helped."""

from __future__ import annotations

from fusion.metrics.measure import OURS, Better, Measure, Trust

ALONG = "of the affected arm's torque in the direction in which the joint moves, at 0.05 rad/s or more, while engaged"
OWN_RANGE = "of the affected joint's angle by the exoskeleton's encoder, in mode free alone"

MEASURES = (
    Measure("own_effort", "N m", f"mean {ALONG}", OURS, Trust.FAIR, "trust.torque", Better.MORE),
    Measure("own_effort_p95", "N m", f"95th percentile {ALONG}", OURS, Trust.FAIR, "trust.torque", Better.MORE),
    Measure("own_range_lowest", "rad", f"2nd percentile {OWN_RANGE}", OURS, Trust.GOOD, "trust.encoder"),
    Measure("own_range_highest", "rad", f"98th percentile {OWN_RANGE}", OURS, Trust.GOOD, "trust.encoder"),
    Measure(
        "own_range", "rad", f"98th minus 2nd percentile {OWN_RANGE}", OURS, Trust.GOOD, "trust.encoder", Better.MORE
    ),
    Measure(
        "own_work",
        "J",
        "positive work of the affected arm, all joints: sum of max(torque × velocity, 0) × time, while engaged",
        OURS,
        Trust.FAIR,
        "trust.torque",
        Better.MORE,
    ),
    Measure(
        "drive_work",
        "J",
        "the same of the drive's own torque, in which the arm's weight is carried",
        OURS,
        Trust.FAIR,
        "trust.work",
    ),
    Measure(
        "own_work_share",
        "1",
        "own work / (own work + work of the drive); 1 minus it is the exoskeleton's share",
        OURS,
        Trust.FAIR,
        "trust.work",
        Better.MORE,
    ),
    Measure(
        "help",
        "1",
        "mean over engaged ticks and joints of the share of the drive's stiffness; 1 = it moved the arm",
        OURS,
        Trust.GOOD,
        "trust.exact",
        Better.LESS,
    ),
    Measure("help_allowed", "1", "mean of the most help allowed in mode assisted", OURS, Trust.GOOD, "trust.exact"),
    Measure("minutes_passive", "min", "time engaged in mode passive", OURS, Trust.GOOD, "trust.exact"),
    Measure("minutes_assisted", "min", "time engaged in mode assisted", OURS, Trust.GOOD, "trust.exact"),
    Measure("minutes_free", "min", "time engaged in mode free", OURS, Trust.GOOD, "trust.exact"),
    Measure("soft_holds", "1", "holds that stayed soft for 0.5 s or longer", OURS, Trust.GOOD, "trust.exact"),
    Measure("pain_calls", "1", "how often pain was pressed", OURS, Trust.GOOD, "trust.exact", Better.LESS),
)
