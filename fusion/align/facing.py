"""Which way the patient faces, and which sensor has taken left for right: one belief, kept over time.

A Kinect mostly takes a back for a front and then names left and right the wrong way round [Yao]; it may
also keep the names right for a while. So a shoulder line says the facing ψ only up to half a turn, and the sensor's own
word does not help. What does: a person turns slowly, a sensor that exchanged its names did so in one frame and goes on
with it, all sensors see one person, and people who walk briskly walk forwards.

The belief is a discrete Bayes filter [Thrun, Burgard, Fox 2005, Probabilistic Robotics, §4.1] over ψ in 72 directions,
with the probability, for each sensor and each ψ, that its names are exchanged. Sensors are taken as independent once ψ
is known, so the cost is linear in their number. ψ is measured in the room's horizontal, 0 along z, positive towards x.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import atan2, exp, hypot, log, pi, radians, sqrt
from typing import Final

import numpy as np

from fusion.align.facing_loops import heard, on_average, turned, usually_named, walked
from fusion.messages import Floats, States
from fusion.skeleton import INDEX

DIRECTIONS: Final = 72
DIRECTION_RAD: Final[Floats] = np.linspace(-np.pi, np.pi, DIRECTIONS, endpoint=False)  # (N,)
TURN_RAD_SQRT_S: Final = radians(100.0)
"""Standard deviation of a person's turn in one second; it grows with the root of time."""
LOOKS_PER_S: Final = 7.5
"""Errors of a sensor last: its frames of one second are worth so many that err independently."""
ERRORS: Final = (5.5, 1.5, 0.07)
"""Concentration (von Mises) of a shoulder line about the truth, towards or away from the lens and side-on, and the
share of lines that say nothing."""
NARROWEST_M, USUAL_M = 0.05, 0.20
"""A shoulder line shorter than the first says nothing, from the second on it counts fully."""
USUAL: Final = (0.02, 0.52)
"""How often names are exchanged that a sensor gives to somebody who faces it, and to a back."""
EXCHANGES_PER_S: Final = 0.01
EXCHANGES_SIDE_ON_PER_S: Final = 2.0
"""How often a sensor thinks again, and how often when it sees the person from the side."""
JUMP_RAD, JUMP_RAD_S, JUMP_SPREAD_RAD = radians(30.0), radians(300.0), radians(6.0)
"""A line that turns by more than the first plus the second times the time between has been thought of anew."""
HALF_TURN_RAD: Final = radians(110.0)
"""A jump further than this can only be an exchange."""
THOUGHT_ANEW: Final = 0.9
NEVER_ANEW: Final = (0.0, 0.0, 0.0)
GAP_S: Final = 0.5
"""A sensor that has not seen the person for this long may name anew."""
FORGOTTEN_S: Final = 3.0
"""After so long without a frame it begins anew."""
SURE_AT_FIRST: Final = 1.5
"""Facing the first sensor is e³ times as likely as turning one's back on it."""
WALKING_M_S: Final = 0.5, 0.9
"""From the first speed on walking begins to tell the facing; from the second on it tells all it can."""
WALK_LOOKS_PER_S: Final = 7.0
LINES: Final = (
    (INDEX["ShoulderLeft"], INDEX["ShoulderRight"], 1.0),
    (INDEX["HipLeft"], INDEX["HipRight"], 0.5),
)
"""Lines across the body, and their length in shoulders' breadths."""
FORWARD_SHARE, SURE_WALK = 0.85, 3.0
"""How often brisk walking is forward walking, and how well it then keeps to the facing."""


@dataclass(frozen=True, slots=True)
class ShoulderLine:
    """Which way a skeleton's shoulders face, by its own names."""

    facing_rad: float
    weight: float
    """0 for a line too short to say anything, 1 for a full one."""
    middle_m: tuple[float, float]
    """Its middle in the room's horizontal, x and z."""


@dataclass(frozen=True, slots=True)
class _Named:
    """What a sensor said last."""

    row: int
    """Of the sensor in `Facing.exchanged`."""
    t_s: float
    facing_rad: float
    """Of its latest line."""


@dataclass(frozen=True, slots=True)
class Facing:
    """The belief at an instant."""

    share: Floats  # (N,) probability of each direction
    exchanged: Floats  # (M, N) probability that a sensor's names are exchanged, given each direction
    sensors: Mapping[str, _Named]
    t_s: float

    @staticmethod
    def at_first(t_s: float, towards_lens_rad: float) -> Facing:
        """Before anything is known: most likely the person faces the sensor that sees them first [Yao]."""
        share = np.exp(SURE_AT_FIRST * np.cos(DIRECTION_RAD - towards_lens_rad))
        return Facing(share / share.sum(), np.empty((0, DIRECTIONS)), {}, t_s)

    @property
    def facing_rad(self) -> float:
        """Mean direction."""
        return float(np.angle(self.share @ np.exp(1j * DIRECTION_RAD)))

    def log_odds_exchanged(self, sensor: str) -> float:
        """The odds that its names are exchanged, ln P − ln (1 − P); 0 for an unknown sensor."""
        named = self.sensors.get(sensor)
        if named is None:
            return 0.0
        exchanged = min(max(on_average(self.share, self.exchanged, named.row), 1e-9), 1.0 - 1e-9)
        return log(exchanged / (1.0 - exchanged))

    def at(self, t_s: float) -> Facing:
        """The belief later on, when the person may have turned; times before the latest change nothing."""
        dt_s = t_s - self.t_s
        if dt_s <= 0.0:
            return self
        spread = TURN_RAD_SQRT_S * sqrt(dt_s) * DIRECTIONS / (2 * pi)
        return Facing(*turned(self.share, self.exchanged, spread), self.sensors, t_s)

    def seen(self, sensor: str, t_s: float, line: ShoulderLine, towards_lens_rad: float) -> Facing:
        """The belief after a sensor's frame; call `at` first.

        Args:
            sensor: who saw it.
            t_s: when.
            line: what it says.
            towards_lens_rad: direction from the person to its lens.
        """
        named = self.sensors.get(sensor)
        apart_s = max(t_s - named.t_s, 0.0) if named else 1.0 / LOOKS_PER_S
        row = named.row if named else len(self.sensors)
        if named is None or apart_s > GAP_S:
            known, anew = self._met_anew(row, towards_lens_rad), NEVER_ANEW
        else:
            known, anew = self.exchanged, _anew(abs(_wrapped(line.facing_rad - named.facing_rad)), apart_s)
        looks = line.weight * min(LOOKS_PER_S * apart_s, 1.0)
        lines = line.facing_rad, towards_lens_rad
        share, exchanged = heard(self.share, known, row, lines, USUAL, anew, ERRORS, looks)
        return Facing(share, exchanged, {**self.sensors, sensor: _Named(row, t_s, line.facing_rad)}, self.t_s)

    def _met_anew(self, row: int, towards_lens_rad: float) -> Floats:
        """P(exchanged) (M, N) with that of a sensor that sees the person for the first time, or again after a gap."""
        usual = usually_named(USUAL, towards_lens_rad, DIRECTIONS)
        if row == len(self.exchanged):
            return np.vstack([self.exchanged, usual])
        exchanged = self.exchanged.copy()
        exchanged[row] = 0.5 * (exchanged[row] + usual)
        return exchanged

    def walked(self, velocity_m_s: tuple[float, float], for_s: float) -> Facing:
        """The belief after the person went with this horizontal velocity (x, z) for so long."""
        slow, brisk = WALKING_M_S
        looks = WALK_LOOKS_PER_S * for_s * min(max((hypot(*velocity_m_s) - slow) / (brisk - slow), 0.0), 1.0)
        if looks <= 0.0:
            return self
        share = walked(self.share, atan2(*velocity_m_s), SURE_WALK, FORWARD_SHARE, looks)
        return Facing(share, self.exchanged, self.sensors, self.t_s)


def shoulder_line(positions_in_room: Floats, state: States) -> ShoulderLine | None:
    """Facing by the shoulders (25, 3), by the hips where a shoulder is lost; None where both are.

    Facing = up × (right − left), in the horizontal; only the direction of the line counts.
    """
    for a, b, usual in LINES:
        if state[a] and state[b]:
            left_x, _, left_z = positions_in_room[a].tolist()
            right_x, _, right_z = positions_in_room[b].tolist()
            x, z = right_x - left_x, right_z - left_z
            weight = min(max((hypot(x, z) / usual - NARROWEST_M) / (USUAL_M - NARROWEST_M), 0.0), 1.0)
            return ShoulderLine(atan2(z, -x), weight, (0.5 * (left_x + right_x), 0.5 * (left_z + right_z)))
    return None


def _anew(jump_rad: float, apart_s: float) -> tuple[float, float, float]:
    """How often a sensor named anew between two frames whose lines differ so much: in any view, besides that side-on,
    and for certain.
    """
    by_jump = THOUGHT_ANEW * _step(jump_rad - JUMP_RAD - JUMP_RAD_S * apart_s)
    certain = THOUGHT_ANEW * _step(jump_rad - HALF_TURN_RAD)
    return by_jump + apart_s * EXCHANGES_PER_S, apart_s * EXCHANGES_SIDE_ON_PER_S, certain


def _step(over_rad: float) -> float:
    return 1.0 / (1.0 + exp(-over_rad / JUMP_SPREAD_RAD))


def _wrapped(angle_rad: float) -> float:
    return (angle_rad + pi) % (2 * pi) - pi
