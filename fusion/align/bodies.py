"""The bodies that one sensor sees: which of them is followed as the patient, and why the others are not.

Body numbers change when somebody is lost, are reused, and may go over to somebody else. So a number is believed only
while the body that wears it moves as a person can and keeps the patient's bone lengths; otherwise the place decides:
nearest to where the patient should be, or, as long as nobody is known, nearest to the lens. Whoever was seen beside the
patient is somebody else, also when the patient is hidden and they stand where the patient was.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from enum import StrEnum
from math import hypot, isnan
from typing import Final

import numpy as np

from fusion.align.loops import apart, middle_seen
from fusion.align.signature import Signature
from fusion.messages import Floats, SkeletonSample, States
from fusion.skeleton import INDEX, JOINT_COUNT

TRUNK: Final = np.array(
    [INDEX[name] for name in ("SpineBase", "SpineMid", "SpineShoulder", "Neck", "ShoulderLeft", "ShoulderRight")]
)
EVERY_JOINT: Final = np.arange(JOINT_COUNT)
ALIVE_S: Final = 0.5
"""A followed body that was not seen for this long may be replaced."""
BESIDE_S: Final = 0.1
"""Two bodies seen within this time are two people."""
VISIBLE_S: Final = 0.3
LOOK_AROUND_S: Final = 0.1
"""A sensor in which nobody is followed is watched this long before one of its bodies is chosen: they come one by one,
and the patient's own number may be the next. Where another sensor sees the patient, there is no need to wait."""
REACH_M, SPEED_M_S, FURTHEST_M = 0.5, 2.0, 1.5
"""How far from where the patient was somebody may be and still be the patient; grows with time up to the furthest."""
UNKNOWN_AFTER_S: Final = 4.0
"""After so long without the patient, the nearest to where they were is taken at any distance."""
JUMP_M, JUMP_SPEED_M_S = 0.6, 6.0
"""A body that moves further than this from one frame to the next is another person with the same number."""
SWIFT_M_S: Final = 3.0
"""No patient's trunk goes so fast: a sensor that loses a body lets it sink through the floor like this."""
SPEED_OVER_S: Final = 0.07
RECENT_FRAMES, PATIENT_FRAMES = 60.0, 600.0
"""Bone lengths of a body are those of the last two seconds; the patient's, of the last twenty."""
FITS, CANNOT_FIT = 1.5, 2.0
"""Misfits of bone lengths: up to the first somebody may be the patient, from the second on a followed body is not.
Of walking people hardly a frame misses their own lengths by the first, and none by the second; of other adults about
half do, and a sixth (docs/alignment.md)."""
CANNOT_FIT_FOR_S: Final = 0.5
PROBATION_S: Final = 3.0
"""A body that was taken up again without a person's word is let go at the first misfit for so long."""


class Verdict(StrEnum):
    """What a body is taken for; the words are what a report and the therapist's page show."""

    PATIENT = "the patient"
    WAITING = "nobody is followed yet"
    BESIDE = "another person: seen beside the patient"
    FAR = "another person: not where the patient is"
    BONES = "another person: other bone lengths"
    SWIFT = "the sensor loses the body: it moves as nobody can"
    UNSEEN = "no joint of the body is seen"


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
        return apart(centre, self.centre_in_sensor) < reach


WhereExpected = Callable[[], Expected | None]
"""Tells where the patient should be, None while that is not known in this sensor's frame."""


@dataclass(frozen=True, slots=True)
class Sighting:
    """A body as it was last seen."""

    body: str
    t_s: float
    since_s: float
    """Since when its wearer has moved as one person."""
    centre_in_sensor: Floats  # (3,)
    build: Signature
    velocity_m_s: tuple[float, float, float]
    """Smoothed."""
    verdict: Verdict = Verdict.WAITING


@dataclass(slots=True)
class BodiesInView:
    """One sensor's bodies and which of them is followed."""

    seen: dict[str, Sighting] = field(default_factory=dict)
    others: set[str] = field(default_factory=set)
    """Bodies that were seen beside the followed one, or had other bones."""
    followed: str | None = None
    followed_since_s: float = np.inf
    confirmed: bool = False
    """Whether a person said so."""
    patient: Signature = field(default_factory=Signature.unknown)
    _misfit_since_s: float | None = None
    _looking_since_s: float = -np.inf
    """Since when anybody has been in view."""
    _heard_s: float = -np.inf

    def confirm(self, body: str) -> None:
        """A person's choice: this body's bones are the patient's."""
        self._follow(body, -np.inf, confirmed=True)
        self.others.clear()
        self.patient = self._build(body)

    def follow_anew(self) -> None:
        """Another sensor's body was chosen by a person: find the same one here, whoever it is."""
        self._follow(None, np.inf)
        self.others.clear()
        self.patient = Signature.unknown()

    def begin_session(self) -> None:
        """Another patient may come: nobody is ruled out or confirmed, and no bones are known."""
        self.others.clear()
        self.confirmed = False
        self.patient = Signature.unknown()

    def prefer(self, body: str, t_s: float) -> None:
        """Follow this body: it moves like the patient in the reference. What was learnt of another one is forgotten."""
        if body != self.followed:
            self._follow(body, t_s)
            self.patient = self._build(body)
            self.others.discard(body)

    def judge(self, sample: SkeletonSample, t_s: float, expected: WhereExpected) -> Verdict:
        """Take one body of one frame."""
        centre = trunk_centre(sample.positions_in_sensor, sample.state)
        if isnan(centre[0]):
            return Verdict.UNSEEN
        if t_s - self._heard_s > VISIBLE_S:
            self._looking_since_s = t_s
        self._heard_s = t_s
        sighting = self._remember(sample, t_s, centre)
        misfit = self.patient.misfit(sighting.build)
        if sighting.body == self.followed:
            self._watch_bones(sighting, misfit)
        self._decide(sighting.body, t_s, expected)
        verdict = self._verdict(sighting.body, expected)
        if verdict is not sighting.verdict:
            self.seen[sighting.body] = replace(sighting, verdict=verdict)
        if verdict is Verdict.PATIENT and misfit < FITS:
            self.patient = self.patient.after(sample.positions_in_sensor, sample.state, PATIENT_FRAMES)
        return verdict

    def reconsider(self, t_s: float, expected: WhereExpected) -> None:
        """The followed body is not where the patient is: take whoever is there, if anybody visible is."""
        where = expected()
        if self.confirmed or where is None:
            return
        rivals = [seen for seen in self.visible(t_s) if seen.body != self.followed and self._fits(seen)]
        there = [seen for seen in rivals if where.admits(seen.centre_in_sensor)]
        if there:
            if self.followed is not None:
                self.others.add(self.followed)
            self._follow(_nearest(there, where.centre_in_sensor), t_s)

    @property
    def misfit(self) -> float:
        """Of the followed body's bones to the patient's."""
        sighting = self.seen.get(self.followed or "")
        return self.patient.misfit(sighting.build) if sighting else 0.0

    def visible(self, t_s: float) -> list[Sighting]:
        """Everybody seen of late."""
        return [seen for seen in self.seen.values() if t_s - seen.t_s < VISIBLE_S]

    def verdict_now(self, seen: Sighting) -> Verdict:
        """What a body is taken for; another may have been chosen since it was last seen."""
        if seen.body == self.followed and seen.verdict is not Verdict.SWIFT:
            return Verdict.PATIENT
        return Verdict.WAITING if seen.verdict is Verdict.PATIENT else seen.verdict

    # --- the steps

    def _follow(self, body: str | None, since_s: float, confirmed: bool = False) -> None:
        self.followed, self.followed_since_s, self.confirmed = body, since_s, confirmed
        self._misfit_since_s = None
        if body is not None:
            self.others.discard(body)

    def _build(self, body: str) -> Signature:
        sighting = self.seen.get(body)
        return sighting.build if sighting else Signature.unknown()

    def _remember(self, sample: SkeletonSample, t_s: float, centre: Floats) -> Sighting:
        """Note where a body is and how it is built; a number that went to somebody else begins anew."""
        before = self.seen.get(sample.body)
        if before is not None and t_s - before.t_s > UNKNOWN_AFTER_S:
            self.others.discard(sample.body)  # numbers are reused: after so long it may be anybody
            before = None
        if before is not None and _jumped(before, t_s, centre):
            self.others.discard(sample.body)
            if self.followed == sample.body:
                self._let_go_of_a_changed_number(t_s)
            before = None
        build = (before.build if before else Signature.unknown()).after(
            sample.positions_in_sensor, sample.state, RECENT_FRAMES
        )
        verdict = before.verdict if before else Verdict.WAITING
        velocity_m_s = _velocity(before, t_s, centre)
        since_s = before.since_s if before else t_s
        sighting = self.seen[sample.body] = Sighting(sample.body, t_s, since_s, centre, build, velocity_m_s, verdict)
        return sighting

    def _let_go_of_a_changed_number(self, t_s: float) -> None:
        """The followed number has another wearer; a number that changed its own just now may be the patient's."""
        self._follow(None, np.inf)
        self.others = {body for body in self.others if self.seen[body].since_s < t_s - BESIDE_S}

    def _watch_bones(self, sighting: Sighting, misfit: float) -> None:
        """Let the followed body go once its bones have long been another person's."""
        probation = not self.confirmed and sighting.t_s - self.followed_since_s < PROBATION_S
        if misfit < (FITS if probation else CANNOT_FIT):
            self._misfit_since_s = None
            return
        if self._misfit_since_s is None:
            self._misfit_since_s = sighting.t_s
        if sighting.t_s - self._misfit_since_s > CANNOT_FIT_FOR_S:
            self._follow(None, np.inf)
            self.others.add(sighting.body)

    def _decide(self, body: str, t_s: float, expected: WhereExpected) -> None:
        """Keep the followed body while it lives, and remember who is beside it; else choose anew."""
        if self.followed is None or self._unseen_s(t_s) > ALIVE_S:
            chosen = self._choose(t_s, expected())
            if chosen is not None and chosen != self.followed:
                self._follow(chosen, t_s)
        elif body != self.followed and self._unseen_s(t_s) < BESIDE_S:
            self.others.add(body)

    def _choose(self, t_s: float, expected: Expected | None) -> str | None:
        """The visible body that is most likely the patient; None while nobody may be."""
        able = [seen for seen in self.visible(t_s) if seen.body not in self.others and self._fits(seen)]
        if expected is not None:
            able = [seen for seen in able if expected.admits(seen.centre_in_sensor)]
        sure = expected is not None and expected.age_s < ALIVE_S
        if not sure and t_s - self._looking_since_s < LOOK_AROUND_S:
            return None
        origin = np.zeros(3) if expected is None else expected.centre_in_sensor
        return _nearest(able, origin) if able else None

    def _fits(self, sighting: Sighting) -> bool:
        return self.patient.misfit(sighting.build) < FITS

    def _unseen_s(self, t_s: float) -> float:
        """For how long the followed body has not been seen; 0 where a person chose it and it has not come yet."""
        last = self.seen.get(self.followed or "")
        return 0.0 if last is None else t_s - last.t_s

    def _verdict(self, body: str, expected: WhereExpected) -> Verdict:
        """Why a body is or is not the patient, as far as can be told in a word."""
        if hypot(*self.seen[body].velocity_m_s) > SWIFT_M_S:
            return Verdict.SWIFT
        if body == self.followed:
            return Verdict.PATIENT
        if not self._fits(self.seen[body]):
            return Verdict.BONES
        if body in self.others:
            return Verdict.BESIDE
        where = expected()
        far = where is not None and not where.admits(self.seen[body].centre_in_sensor)
        return Verdict.FAR if far else Verdict.WAITING


def trunk_centre(positions: Floats, state: States) -> Floats:
    """Median of the trunk's seen joints (3,), of all joints where the trunk is not seen; NaN when nothing is."""
    centre = middle_seen(positions, state, TRUNK)
    return middle_seen(positions, state, EVERY_JOINT) if isnan(centre[0]) else centre


def _nearest(seen: list[Sighting], to: Floats) -> str:
    return min(seen, key=lambda one: apart(one.centre_in_sensor, to)).body


def _velocity(before: Sighting | None, t_s: float, centre: Floats) -> tuple[float, float, float]:
    """Of a trunk, smoothed over a few frames; 0 after a silence."""
    dt = t_s - before.t_s if before else 0.0
    if before is None or not 0.0 < dt < ALIVE_S:
        return 0.0, 0.0, 0.0
    share = min(dt / SPEED_OVER_S, 1.0)
    x, y, z = (centre - before.centre_in_sensor).tolist()
    was_x, was_y, was_z = ((1.0 - share) * speed for speed in before.velocity_m_s)
    return was_x + share * x / dt, was_y + share * y / dt, was_z + share * z / dt


def _jumped(before: Sighting, t_s: float, centre: Floats) -> bool:
    """Whether a number went to somebody else; after a silence anybody may have walked anywhere."""
    dt = t_s - before.t_s
    return dt < ALIVE_S and apart(before.centre_in_sensor, centre) > JUMP_M + JUMP_SPEED_M_S * max(dt, 0.0)
