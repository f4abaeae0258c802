"""Time, pain, and how well the sensors served."""

from __future__ import annotations

from fusion.metrics.measure import HAND_FILTER, OURS, Better, Measure, PublishedChange, Trust

ASKED = "a number from 0 (none) to 10, asked of the patient"
STATES = ("off", "ready", "engaged", "hold", "fault", "stopped")

TIMES = tuple(
    Measure(
        f"time_{state}",
        "s",
        f"time in the safety gate's state {state}; holes over 0.5 s count for none",
        OURS,
        Trust.GOOD,
        "trust.exact",
    )
    for state in STATES
)
MEASURES = (
    *TIMES,
    Measure(
        "active_minutes",
        "min",
        "time within the healthy hand's movements, all together",
        OURS,
        Trust.GOOD,
        "trust.movements",
        Better.MORE,
        HAND_FILTER,
        trust_of_one=Trust.POOR,
        camera_error=0.0026,
    ),
    Measure("sensor_frame_rate", "Hz", "median of a sensor's frames per second", OURS, Trust.GOOD, "trust.exact"),
    Measure(
        "sensor_residual",
        "m",
        "median distance of a sensor's joints to the reference sensor's after alignment",
        OURS,
        Trust.GOOD,
        "trust.exact",
    ),
    Measure(
        "sensor_age_p95", "s", "95th percentile of the age of a sensor's last frame", OURS, Trust.GOOD, "trust.exact"
    ),
)
PAIN_MCID = PublishedChange(2.17, "Michener et al., J Sport Rehabil 20:115–128, 2011", "shoulder pain")
ASKED_MEASURES = tuple(
    Measure(
        f"pain_{when}",
        "1",
        f"{when} the session: {ASKED}",
        "numeric rating scale",
        Trust.GOOD,
        "trust.asked",
        Better.LESS,
        mcid=PAIN_MCID,
    )
    for when in ("before", "after")
)
