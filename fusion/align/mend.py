"""Left and right exchanged by a sensor: put back where that is known, left out where the sensors contradict.

`facing` keeps the belief; here it is asked at every frame. A line that still points against another sensor's cannot be
the same shoulders, so the sided joints of the one that comes second, or is less sure, are not used.
"""

from __future__ import annotations

from collections import defaultdict, deque
from dataclasses import dataclass, replace
from enum import StrEnum
from math import atan2, copysign, cos, pi

import numpy as np

from fusion.align.facing import FORGOTTEN_S, Facing, ShoulderLine, shoulder_line
from fusion.messages import AlignedSample
from fusion.skeleton import INDEX, SIDES_SWAPPED, TrackingState

SIDED = np.nonzero(np.arange(len(SIDES_SWAPPED)) != SIDES_SWAPPED)[0]
AGREEMENT_NATS = 1.5
"""Lines of rightly named frames are opposed so much more seldom (factor e^1.5) than where one has exchanged names."""
KEPT_NATS = 0.5
"""What was decided stays until the odds are this much against it."""
SURER_NATS = 1.0
"""A frame this much surer of its names displaces the other sensor's."""
BESIDE_S = 0.1
"""Lines of two sensors within this time are held against one another."""
STRIDE_S, LEAST_STRIDE_S = 0.5, 0.3
"""Walking is seen over this long."""
PELVIS = INDEX["SpineBase"]


class Mending(StrEnum):
    """What was done to a frame; the words are what a report shows."""

    NONE = "none"
    SWAPPED_BACK = "left and right were exchanged, put back"
    SIDES_REFUSED = "left and right cannot be told, sided joints not used"


@dataclass(frozen=True, slots=True)
class _Decided:
    """What was made of a sensor's latest frame."""

    t_s: float
    facing_rad: float
    """Of its line once mended."""
    odds: float
    """ln P(exchanged) − ln P(not)."""
    used: bool


class SideKeeper:
    """Keeps left and right apart in every sensor's frames; takes them in the order they come."""

    def __init__(self) -> None:
        self._facing: Facing | None = None
        self._decided: dict[str, _Decided] = {}
        self._way: defaultdict[str, deque[tuple[float, float, float]]] = defaultdict(deque)

    @property
    def facing(self) -> Facing | None:
        """What is believed now; None before the first frame."""
        return self._facing

    def mend(self, sample: AlignedSample) -> tuple[AlignedSample, Mending]:
        """Put exchanged sides back, or leave the sided joints out.

        Args:
            sample: a frame of the patient, in the room.
        """
        line = shoulder_line(sample.positions_in_room, sample.state)
        if line is None:
            return self._as_before(sample)
        lens_rad = _towards_lens(sample, line)
        before = self._known(sample.t_s) or Facing.at_first(sample.t_s, lens_rad)
        belief = self._walked(before.at(sample.t_s), sample, sample.t_s - before.t_s)
        self._facing = belief.seen(sample.sensor, sample.t_s, line, lens_rad)
        decided = self._decide(sample, line, self._facing.log_odds_exchanged(sample.sensor))
        self._decided[sample.sensor] = decided
        return _mended(sample, decided)

    def _known(self, t_s: float) -> Facing | None:
        """The belief, unless nobody was seen for too long."""
        if self._facing is None or t_s - self._facing.t_s > FORGOTTEN_S:
            self._decided.clear()
            return None
        return self._facing

    def _as_before(self, sample: AlignedSample) -> tuple[AlignedSample, Mending]:
        """A frame without a line keeps its sensor's latest decision."""
        decided = self._decided.get(sample.sensor)
        return (sample, Mending.NONE) if decided is None else _mended(sample, decided)

    def _walked(self, belief: Facing, sample: AlignedSample, for_s: float) -> Facing:
        """Take in where the sensor has seen the person go, for the time since anybody saw them."""
        way = self._way[sample.sensor]
        if not sample.state[PELVIS] or (way and sample.t_s <= way[-1][0]):
            return belief
        x, _, z = sample.positions_in_room[PELVIS].tolist()
        way.append((sample.t_s, x, z))
        while way[0][0] < sample.t_s - STRIDE_S:
            way.popleft()
        from_s, from_x, from_z = way[0]
        took_s = sample.t_s - from_s
        if took_s < LEAST_STRIDE_S:
            return belief
        return belief.walked(((x - from_x) / took_s, (z - from_z) / took_s), for_s)

    def _decide(self, sample: AlignedSample, line: ShoulderLine, odds: float) -> _Decided:
        """Exchanged or not, and whether the frame's sides are used."""
        before = self._decided.get(sample.sensor)
        kept = copysign(KEPT_NATS, before.odds) if before else 0.0
        others = self._beside(sample)
        agree = sum([copysign(1.0, cos(line.facing_rad - other.facing_rad)) for other in others.values()])
        odds += kept - AGREEMENT_NATS * agree
        facing_rad = line.facing_rad + (pi if odds > 0 else 0.0)
        opposed = {name: other for name, other in others.items() if cos(facing_rad - other.facing_rad) < 0}
        surer = all([abs(odds) > abs(other.odds) + SURER_NATS for other in opposed.values()])
        for name, other in opposed.items() if surer else ():
            self._decided[name] = replace(other, used=False)
        return _Decided(sample.t_s, facing_rad, odds, surer)

    def _beside(self, sample: AlignedSample) -> dict[str, _Decided]:
        """The other sensors' latest frames that are used and near enough in time."""
        return {
            name: decided
            for name, decided in self._decided.items()
            if name != sample.sensor and decided.used and abs(sample.t_s - decided.t_s) < BESIDE_S
        }


def _mended(sample: AlignedSample, decided: _Decided) -> tuple[AlignedSample, Mending]:
    if not decided.used:
        return _without_sides(sample), Mending.SIDES_REFUSED
    return (_swapped(sample), Mending.SWAPPED_BACK) if decided.odds > 0 else (sample, Mending.NONE)


def _towards_lens(sample: AlignedSample, line: ShoulderLine) -> float:
    """Direction from the person to the lens, in the horizontal."""
    lens_x, _, lens_z = sample.lens_in_room.tolist()
    return atan2(lens_x - line.middle_m[0], lens_z - line.middle_m[1])


def _swapped(sample: AlignedSample) -> AlignedSample:
    return replace(sample, positions_in_room=sample.positions_in_room[SIDES_SWAPPED], state=sample.state[SIDES_SWAPPED])


def _without_sides(sample: AlignedSample) -> AlignedSample:
    state = sample.state.copy()
    state[SIDED] = TrackingState.LOST
    return replace(sample, state=state)
