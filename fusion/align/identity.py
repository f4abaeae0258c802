"""Which body of each sensor is the patient: one person is followed, everybody else is refused.

Body numbers say nothing across sensors, change when somebody is lost, and are reused. So a number is believed only
while the body that wears it moves as a person can; otherwise the place decides: nearest to where the patient was, or,
as long as nobody is known, nearest to the lens. Whoever was seen beside the patient is somebody else, also when the
patient is hidden and they stand where the patient was. A person's choice goes before everything.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from math import dist, isnan

import numpy as np

from fusion.align.loops import middle_seen
from fusion.messages import Floats, SkeletonSample, States
from fusion.skeleton import INDEX, JOINT_COUNT

TRUNK = np.array(
    [INDEX[name] for name in ("SpineBase", "SpineMid", "SpineShoulder", "Neck", "ShoulderLeft", "ShoulderRight")]
)
EVERY_JOINT = np.arange(JOINT_COUNT)
ALIVE_S = 0.5
"""A followed body that was not seen for this long may be replaced."""
BESIDE_S = 0.1
"""Two bodies seen within this time are two people."""
VISIBLE_S = 0.3
LOOK_AROUND_S = 0.1
"""A sensor that starts is watched this long before its nearest body is chosen."""
REACH_M, SPEED_M_S, FURTHEST_M = 0.5, 2.0, 1.5
"""How far from where the patient was somebody may be and still be the patient; grows with time up to the furthest."""
UNKNOWN_AFTER_S = 4.0
"""After so long without the patient, the nearest to where they were is taken at any distance."""
JUMP_M, JUMP_SPEED_M_S = 0.6, 6.0
"""A body that moves further than this from one frame to the next is another person with the same number."""


@dataclass(frozen=True, slots=True)
class Expected:
    """Where the patient's trunk should be in a sensor's own frame, and for how long nobody has confirmed it."""

    centre_in_sensor: Floats  # (3,)
    age_s: float

    def admits(self, centre: Floats) -> bool:
        """Whether somebody at `centre` (3,) may be the patient."""
        if self.age_s > UNKNOWN_AFTER_S:
            return True
        reach = min(REACH_M + SPEED_M_S * self.age_s, FURTHEST_M)
        return bool(np.linalg.norm(centre - self.centre_in_sensor) < reach)


@dataclass(frozen=True, slots=True)
class Sighting:
    """A body as it was last seen by one sensor."""

    body: str
    t_s: float
    centre_in_sensor: Floats  # (3,)


@dataclass(slots=True)
class _View:
    """One sensor's bodies and which of them is followed."""

    since_s: float
    seen: dict[str, Sighting] = field(default_factory=dict)
    others: set[str] = field(default_factory=set)
    """Bodies that were seen beside the followed one."""
    followed: str | None = None

    def choose(self, body: str | None) -> None:
        """Follow another body."""
        if body != self.followed:
            self.followed = body
            self.others.clear()


def trunk_centre(positions: Floats, state: States) -> Floats:
    """Median of the trunk's seen joints (3,), of all joints where the trunk is not seen; NaN when nothing is."""
    centre = middle_seen(positions, state, TRUNK)
    return middle_seen(positions, state, EVERY_JOINT) if isnan(centre[0]) else centre


class PatientFinder:
    """Follows one person in every sensor."""

    def __init__(self) -> None:
        self._views: dict[str, _View] = {}

    def follow(self, sensor: str, body: str) -> None:
        """A person's choice: this body is the patient. The other sensors find the same person by place."""
        for view in self._views.values():
            view.choose(None)
        self._views.setdefault(sensor, _View(-np.inf)).choose(body)

    def begin_session(self) -> None:
        """Another patient may come: who stood beside the last one may be the next."""
        for view in self._views.values():
            view.others.clear()

    def prefer(self, sensor: str, body: str | None) -> None:
        """Follow this body in one sensor, as it moves like the patient in the reference; None changes nothing."""
        if body is not None and sensor in self._views:
            self._views[sensor].choose(body)

    def followed(self, sensor: str) -> str | None:
        """The body followed in a sensor."""
        view = self._views.get(sensor)
        return view.followed if view else None

    def is_patient(self, sample: SkeletonSample, t_s: float, expected: Callable[[], Expected | None]) -> bool:
        """Take one body of one frame; True when it is the patient's.

        Args:
            sample: the body.
            t_s: its time on the receive clock.
            expected: tells where the patient should be, None while that is not known in this sensor's frame; asked
                only where somebody has to be chosen.
        """
        centre = trunk_centre(sample.positions_in_sensor, sample.state)
        if isnan(centre[0]):
            return False
        view = self._views.setdefault(sample.sensor, _View(t_s))
        before = view.seen.get(sample.body)
        view.seen[sample.body] = Sighting(sample.body, t_s, centre)
        if before is not None and t_s - before.t_s > UNKNOWN_AFTER_S:
            view.others.discard(sample.body)  # numbers are reused: after so long it may be anybody
        if before is not None and _jumped(before, view.seen[sample.body]):
            view.others.discard(sample.body)
            view.followed = None if view.followed == sample.body else view.followed
        self._decide(view, sample.body, t_s, expected)
        return view.followed == sample.body

    def _decide(self, view: _View, body: str, t_s: float, expected: Callable[[], Expected | None]) -> None:
        """Keep the followed body while it lives, and remember who is beside it; else choose anew."""
        if view.followed is None or _unseen_s(view, t_s) > ALIVE_S:
            view.followed = _choose(view, t_s, expected()) or view.followed
        elif body != view.followed and _unseen_s(view, t_s) < BESIDE_S:
            view.others.add(body)


def _jumped(before: Sighting, now: Sighting) -> bool:
    """Whether a number went to somebody else; after a silence anybody may have walked anywhere."""
    dt = now.t_s - before.t_s
    moved = dist(before.centre_in_sensor, now.centre_in_sensor)
    return dt < ALIVE_S and moved > JUMP_M + JUMP_SPEED_M_S * max(dt, 0.0)


def _unseen_s(view: _View, t_s: float) -> float:
    """For how long the followed body has not been seen; 0 where a person chose it and it has not come yet."""
    last = view.seen.get(view.followed or "")
    return 0.0 if last is None else t_s - last.t_s


def _choose(view: _View, t_s: float, expected: Expected | None) -> str | None:
    """The visible body that is most likely the patient; None while nobody may be."""
    recent = (seen for seen in view.seen.values() if t_s - seen.t_s < VISIBLE_S)
    visible = [seen for seen in recent if seen.body not in view.others]
    if expected is not None:
        visible = [seen for seen in visible if expected.admits(seen.centre_in_sensor)]
        origin = expected.centre_in_sensor
    else:
        origin = np.zeros(3)
        if t_s - view.since_s < LOOK_AROUND_S:
            return None
    if not visible:
        return None
    return min(visible, key=lambda seen: float(np.linalg.norm(seen.centre_in_sensor - origin))).body
