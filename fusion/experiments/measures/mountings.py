"""How far off the paper's alignment and ours put a body, where they were fitted and after it has moved."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.align.alignment import SensorAlignment
from fusion.align.bursa import BursaFit, bursa
from fusion.align.track import BodyTrack, Pairs, pair
from fusion.align.whole import align_streams
from fusion.messages import Floats
from fusion.recording.recording import Recording
from fusion.skeleton import Side
from fusion.virtual_patient.sensor import DEMO, NoiseLevel
from fusion.virtual_patient.trial import sensors_for, virtual_recording

MOVED_M: Final = 0.8
"""Where the model of small angles is asked about again."""
STEPS: Final = MOVED_M * np.array([[1.0, 0, 0], [-1.0, 0, 0], [0, 0, 1.0], [0, 0, -1.0]])


@dataclass(frozen=True, slots=True)
class Placed:
    """Root mean square, over joints and time, of how far off a mounting puts them; metres."""

    here_m: float
    """Where it was fitted."""
    moved_m: float
    """After moving by 0.8 m, to the sides, near and far."""


@dataclass(frozen=True, slots=True)
class Fits:
    """The two mountings of the second sensor against the first."""

    bursa: BursaFit
    ours: SensorAlignment
    pairs: Pairs


def fits_of(recording: Recording) -> Fits:
    """Fit both to a recording of one person by two sensors; the paper's is given our clock offset."""
    first, second = sorted(recording.skeleton_streams, key=lambda stream: not stream.primary)
    ours = align_streams(recording.skeleton_streams, first.sensor).alignments[second.sensor]
    pairs = pair(BodyTrack.of(first.samples), BodyTrack.of(second.samples), ours.clock_offset_s)
    seen = (pairs.weight > 0)[..., None]
    return Fits(bursa(np.where(seen, pairs.reference, np.nan), np.where(seen, pairs.sensor, np.nan)), ours, pairs)


def placed(seed: int, left_over_rad: float, length_s: float, noise: NoiseLevel = DEMO) -> tuple[Placed, Placed]:
    """The paper's and ours, for a second sensor at 90° and `left_over_rad`; against the true places.

    Args:
        seed: of patient and sensors.
        left_over_rad: how far the mounting is from the right angle.
        length_s: of what they are fitted to.
        noise: of both sensors.
    """
    apart_rad = np.pi / 2 + left_over_rad
    recording = virtual_recording(seed, length_s, noise=noise, clock_offset_s=0.0, apart_rad=apart_rad)
    fits = fits_of(recording)
    first, second = (sensor.pose for sensor in sensors_for(Side.RIGHT, seed, noise, 0.0, apart_rad))
    in_first = recording.truth.positions[::10] if recording.truth is not None else np.zeros((0, 25, 3))
    here = first.position_in_world + in_first @ first.rotation_sensor_to_world.T
    moved = np.concatenate([here + step for step in STEPS])

    def off_m(fit: BursaFit | SensorAlignment, body: Floats) -> float:
        error = fit.in_reference(second.to_sensor(body)) - first.to_sensor(body)
        return float(np.sqrt(np.mean(np.sum(error**2, axis=-1))))

    return Placed(off_m(fits.bursa, here), off_m(fits.bursa, moved)), Placed(
        off_m(fits.ours, here), off_m(fits.ours, moved)
    )


def median_apart_m(pairs: Pairs, fit: BursaFit | SensorAlignment, frames: slice = slice(None)) -> float:
    """Median distance of the two sensors' joints as placed by a fit."""
    apart = np.linalg.norm(pairs.reference[frames] - fit.in_reference(pairs.sensor[frames]), axis=2)
    return float(np.median(apart[pairs.weight[frames] > 0]))


def rms(values: Sequence[float]) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(np.square(values))))
