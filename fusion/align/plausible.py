"""Senders that cannot be right: mirrored, with left and right exchanged, or in a wrong unit: fatal in therapy."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from fusion.align.space import Moments, mounting
from fusion.align.track import BodyTrack, Pairs
from fusion.messages import Floats, States
from fusion.skeleton import INDEX, SIDES_SWAPPED, TrackingState

SEGMENTS = (
    ("ShoulderLeft", "ElbowLeft", 0.28),
    ("ElbowLeft", "WristLeft", 0.25),
    ("ShoulderRight", "ElbowRight", 0.28),
    ("ElbowRight", "WristRight", 0.25),
    ("ShoulderLeft", "ShoulderRight", 0.36),
    ("HipLeft", "KneeLeft", 0.40),
    ("HipRight", "KneeRight", 0.40),
    ("KneeLeft", "AnkleLeft", 0.38),
    ("KneeRight", "AnkleRight", 0.38),
)
"""Segments and their usual length in metres (Winter 2009, a person of 1.70 m, as a Kinect shows them)."""
SMALLEST, LARGEST = 0.45, 1.6
"""Scale of a person against that: from a child of 80 cm to the tallest."""
UNITS = {"millimetres": 1000.0, "centimetres": 100.0, "inches": 39.37, "feet": 3.281, "kilometres": 0.001}
CLEARLY_BETTER = 0.6
"""Another handedness must leave less than this share of the residual."""
LEAST_GAIN_M = 0.03
MIRROR = np.array([-1.0, 1.0, 1.0])


@dataclass(frozen=True, slots=True)
class Fault:
    """What is wrong with a sender, and what a person can do."""

    what: str
    remedy: str

    def __str__(self) -> str:
        return f"{self.what}; it is not used. {self.remedy}"


EXCHANGED = Fault("left and right joints are exchanged", "Correct the joint names in the sender")
MIRRORED = Fault("the picture is mirrored", "Switch mirroring off in the sender")
MIRROR_IMAGE = Fault("it sends a mirror image of the person", "Switch the sender's mirror or selfie mode off")


def unit_fault(positions: Floats, state: States) -> Fault | None:
    """A wrong unit, told by the lengths of arms, legs and shoulders.

    Args:
        positions: (N, J, 3) as sent.
        state: (N, J).
    """
    scale = _scale(positions, state)
    if not np.isfinite(scale) or SMALLEST < scale < LARGEST:
        return None
    unit = min(UNITS, key=lambda name: abs(np.log(max(scale, 1e-9) / UNITS[name])))
    known = abs(np.log(max(scale, 1e-9) / UNITS[unit])) < np.log(2.0)
    guess = f"as if in {unit}" if known else "in an unknown unit"
    return Fault(f"bones are {scale:.3g} times as long as a person's, {guess}", "Make the sender give metres")


def _scale(positions: Floats, state: States) -> float:
    """Median ratio of the segments to their usual lengths; NaN when none is seen."""
    seen = np.where((state == TrackingState.TRACKED)[..., None], positions, np.nan)
    starts, ends = [INDEX[start] for start, _, _ in SEGMENTS], [INDEX[end] for _, end, _ in SEGMENTS]
    ratios = np.linalg.norm(seen[:, starts] - seen[:, ends], axis=2) / np.array([usual for *_, usual in SEGMENTS])
    known = ratios[np.isfinite(ratios)]
    return float(np.median(known)) if known.size else float("nan")


def handedness_fault(pairs: Pairs) -> Fault | None:
    """A sensor that becomes consistent with the reference only as a mirror image, or with its sides exchanged."""
    if pairs.frames == 0:
        return None
    straight = _coarse_residual(pairs)
    others = {
        EXCHANGED: _coarse_residual(_exchanged(pairs)),
        MIRRORED: _coarse_residual(_mirrored(pairs)),
        MIRROR_IMAGE: _coarse_residual(_mirrored(_exchanged(pairs))),
    }
    best = min(others, key=lambda fault: others[fault])
    better = others[best] < CLEARLY_BETTER * straight and straight - others[best] > LEAST_GAIN_M
    return best if better else None


def _coarse_residual(pairs: Pairs) -> float:
    """Median distance under the plain best fit; enough to tell hands apart, and cheap enough for a tick."""
    moments = Moments.of(pairs.reference.reshape(-1, 3), pairs.sensor.reshape(-1, 3), pairs.weight.ravel())
    distance = np.linalg.norm(mounting(moments).errors(pairs), axis=2)[pairs.weight > 0]
    return float(np.median(distance))


def _exchanged(pairs: Pairs) -> Pairs:
    weight = np.where(pairs.weight > 0, pairs.weight[:, SIDES_SWAPPED], 0.0)
    return replace(pairs, sensor=pairs.sensor[:, SIDES_SWAPPED], weight=weight)


def _mirrored(pairs: Pairs) -> Pairs:
    return replace(pairs, sensor=pairs.sensor * MIRROR)


def feet_fault(track: BodyTrack) -> Fault | None:
    """A sender whose people walk on backward feet: mirrored, or with left and right exchanged.

    Facing is up the spine × towards the right shoulder; toes point that way in every real body, and against it in a
    body that is mirrored or has its sides exchanged (both together look right, and need a second sensor to be found).
    """
    seen = np.where((track.state == TrackingState.TRACKED)[..., None], track.positions, np.nan)

    def at(name: str) -> Floats:
        found: Floats = seen[:, INDEX[name]]
        return found

    across, up = at("ShoulderRight") - at("ShoulderLeft"), at("SpineShoulder") - at("SpineBase")
    facing = np.cross(up, across)
    toes = at("FootLeft") - at("AnkleLeft") + at("FootRight") - at("AnkleRight")
    agreement = np.einsum("ni,ni->n", facing, toes) / (
        np.linalg.norm(facing, axis=1) * np.linalg.norm(toes, axis=1) + 1e-9
    )
    known = agreement[np.isfinite(agreement)]
    if len(known) < 60 or np.mean(known < -0.3) < 0.9:
        return None
    return Fault("toes point backwards: the picture is mirrored, or left and right are exchanged", MIRRORED.remedy)
