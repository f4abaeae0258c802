"""What inertial sensors and cameras have taught about the bones, as rules for one instant; and how it is learnt."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np

from fusion.joined import attitude
from fusion.joined.attitude import Attitude
from fusion.joined.boxes import Offset
from fusion.joined.evidence import Evidence
from fusion.joined.sites import BONES_AT, GIVE_M
from fusion.messages import FusedFrame, SegmentSample
from fusion.skeleton import TrackingState

RATE_RAD_S: Final = 6.0
"""No segment turns faster; what the age of a sample adds to its tolerance."""
Attitudes = Mapping[str, Attitude]


def learn(attitudes: Attitudes, evidence: Evidence, frame: FusedFrame) -> Attitudes:
    """Hold every inertial sensor against the body that cameras tell."""
    learnt: dict[str, Attitude] = {}
    for site, bones in BONES_AT.items():  # the same order whoever spoke first, so that sums round alike
        sample, known = evidence.segment(site, frame.t_s), attitudes.get(site)
        if sample is not None:
            known = _learn_one(known or attitude.unknown(len(bones)), sample, frame)
        if known is not None:
            learnt[site] = known
    return learnt


def _learn_one(known: Attitude, sample: SegmentSample, frame: FusedFrame) -> Attitude:
    parents, children = np.array(BONES_AT[sample.site]).T
    tracked = frame.state == TrackingState.TRACKED
    vectors = frame.positions_in_room[children] - frame.positions_in_room[parents]
    seen = tracked[parents] & tracked[children]
    return attitude.learn(known, frame.t_s, sample.rotation_sensor_to_earth, vectors, seen)


def offsets(attitudes: Attitudes, evidence: Evidence, t_s: float) -> tuple[Offset, ...]:
    """The vectors of all bones with a sensor that speaks now and is known."""
    return tuple(
        offset
        for site, known in attitudes.items()
        if known.known and (sample := evidence.segment(site, t_s)) is not None
        for offset in _offsets_of(known, sample, t_s)
    )


def _offsets_of(known: Attitude, sample: SegmentSample, t_s: float) -> list[Offset]:
    rotation = sample.rotation_sensor_to_earth
    vectors = attitude.vectors_in_room(known, rotation)
    age = RATE_RAD_S * (t_s - sample.t_s) * np.linalg.norm(vectors, axis=1)
    slack = attitude.tolerances_m(known, rotation, t_s) + age + GIVE_M[sample.site]
    return [
        Offset(parent, child, vector, float(tolerance_m))
        for (parent, child), vector, tolerance_m in zip(BONES_AT[sample.site], vectors, slack, strict=True)
    ]
