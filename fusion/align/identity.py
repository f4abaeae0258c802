"""Who the patient is: one person is followed in every sensor, everybody else is refused.

Each sensor's bodies are judged by themselves (`bodies`). Sensors whose place is known are also held against one
another: a body that is not where a surer sensor sees the patient is not used. Surer is who was confirmed by a person,
then whose body has the patient's bones, then who has followed longer. A person's choice goes before everything.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from typing import Final

from fusion.align.bodies import FITS, BodiesInView, Verdict, WhereExpected
from fusion.align.loops import apart
from fusion.messages import Floats, SkeletonSample

APART_M: Final = 0.5
"""Two sensors' middles of one trunk are never so far apart: their joints differ by 0.06 m, and by three times that
while a mounting is learnt."""
APART_FOR_S: Final = 0.3
"""After so long, whoever stands where the patient should be is taken instead."""
TOGETHER_S: Final = 0.2
"""Places of two sensors are held against one another within this time."""


@dataclass(frozen=True, slots=True)
class BodyInView:
    """A body that a sensor sees now, for the therapist to say who the patient is."""

    sensor: str
    body: str
    centre_in_sensor: Floats  # (3,)
    verdict: Verdict
    confirmed: bool
    """Whether a person said that this is the patient."""
    centre_in_room: Floats | None = None
    """(3,), where the sensor's place is known."""


@dataclass(frozen=True, slots=True)
class _Place:
    """Where a sensor saw the patient last."""

    t_s: float
    centre_in_room: Floats  # (3,)
    apart_since_s: float | None
    """Since when surer sensors have seen the patient elsewhere."""


class PatientFinder:
    """Follows one person in every sensor."""

    def __init__(self) -> None:
        self._views: defaultdict[str, BodiesInView] = defaultdict(BodiesInView)
        self._places: dict[str, _Place] = {}

    def follow(self, sensor: str, body: str) -> bool:
        """A person's choice: this body is the patient. The other sensors find the same person by place.

        Returns:
            Whether it is another one than before.
        """
        chosen = self._views[sensor]
        is_another = chosen.followed != body
        for view in self._views.values() if is_another else ():
            view.follow_anew()
        self._places.clear()
        chosen.confirm(body)
        return is_another

    def begin_session(self) -> None:
        """Another patient may come: who stood beside the last one may be the next."""
        for view in self._views.values():
            view.begin_session()

    def prefer(self, sensor: str, body: str | None, t_s: float) -> None:
        """Follow this body in one sensor, as it moves like the patient in the reference; None changes nothing."""
        if body is not None and sensor in self._views:
            self._views[sensor].prefer(body, t_s)

    def followed(self, sensor: str) -> str | None:
        """The body followed in a sensor."""
        view = self._views.get(sensor)
        return view.followed if view else None

    def bodies(self, t_s: float) -> tuple[BodyInView, ...]:
        """Everybody in view at `t_s` (receive clock), the patient included."""
        return tuple(
            BodyInView(
                sensor,
                seen.body,
                seen.centre_in_sensor,
                view.verdict_now(seen),
                view.confirmed and seen.body == view.followed,
            )
            for sensor, view in self._views.items()
            for seen in view.visible(t_s)
        )

    def judge(self, sample: SkeletonSample, t_s: float, expected: WhereExpected) -> Verdict:
        """Take one body of one frame.

        Args:
            sample: the body.
            t_s: its time on the receive clock.
            expected: where the patient should be; asked only where somebody has to be chosen or refused.
        """
        return self._views[sample.sensor].judge(sample, t_s, expected)

    def agrees(self, sensor: str, t_s: float, centre_in_room: Floats, expected: WhereExpected) -> bool:
        """Whether a sensor's patient is where every surer sensor sees theirs.

        Args:
            sensor: that sees its patient.
            t_s: aligned time.
            centre_in_room: (3,) the patient's middle by this sensor.
            expected: where the patient should be in this sensor's frame.
        """
        before = self._places.get(sensor)
        is_apart = self._elsewhere(sensor, t_s, centre_in_room)
        since_s = (
            (t_s if before is None or before.apart_since_s is None else before.apart_since_s) if is_apart else None
        )
        self._places[sensor] = _Place(t_s, centre_in_room, since_s)
        if since_s is not None and t_s - since_s > APART_FOR_S:
            self._views[sensor].reconsider(t_s, expected)
        return not is_apart

    def _elsewhere(self, sensor: str, t_s: float, centre_in_room: Floats) -> bool:
        """Whether a surer sensor sees the patient elsewhere just now."""
        return any(
            abs(t_s - place.t_s) < TOGETHER_S
            and apart(place.centre_in_room, centre_in_room) > APART_M
            and self._sureness(other) > self._sureness(sensor)
            for other, place in self._places.items()
            if other != sensor
        )

    def _sureness(self, sensor: str) -> tuple[bool, bool, float, int]:
        """Of two that are equal in everything, the one that came first."""
        view = self._views[sensor]
        return view.confirmed, view.misfit < FITS, -view.followed_since_s, -list(self._views).index(sensor)
