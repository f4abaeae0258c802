"""What a recording holds once it has been read, whichever form it was stored in."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fusion.messages import Floats, SkeletonSample
from fusion.skeleton import Side


@dataclass(frozen=True, slots=True)
class SkeletonStream:
    """Everything one sensor saw, in its own frame."""

    sensor: str
    primary: bool
    """The sensor that the recording names as reference; exactly one is."""
    clock: str
    """Whose clock `t_s` is: "sensor" = its own."""
    samples: tuple[SkeletonSample, ...]
    """Sorted by `t_s`; one sample per instant and body. An interchange folder knows no receive time: there
    `t_received_s` equals `t_s`."""


@dataclass(frozen=True, slots=True)
class RangeStream:
    """Distances between anchors that stand and tags that move, measured by radio; R samples sorted by time."""

    anchors: tuple[str, ...]  # (A,)
    anchor_positions: Floats  # (A, 3) m, z up
    tags: tuple[str, ...]  # (K,)
    t_s: Floats  # (R,)
    anchor: NDArray[np.int64]  # (R,) index into `anchors`
    tag: NDArray[np.int64]  # (R,) index into `tags`
    range_m: Floats  # (R,)


@dataclass(frozen=True, slots=True)
class TruthStream:
    """Where the joints (or tags) really were."""

    t_s: Floats  # (T,) in the clock of the stream that `clock` names
    joints: tuple[str, ...]  # (N,) joint names, or tag names in a ranging recording
    positions: Floats  # (T, N, 3) m, in the primary sensor's frame; NaN where there is no truth
    clock: str = ""


@dataclass(frozen=True, slots=True)
class ImuStream:
    """What one inertial sensor measured, in its own axes."""

    site: str
    """Where it sits: `upper-arm-left`, `forearm-left`, `hand-left`, …, `upper-back`."""
    t_s: Floats  # (T,) rising
    gyro_rad_s: Floats  # (T, 3)
    accel_m_s2: Floats  # (T, 3) specific force: a sensor at rest measures 9.81 upwards
    magnet_ut: Floats | None = None  # (T, 3) microtesla
    orientation: Floats | None = None  # (T, 4) sensor to earth, w first, as the sensor itself said it


@dataclass(frozen=True, slots=True)
class OrientationTruth:
    """How an inertial sensor was really turned."""

    t_s: Floats  # (T,)
    orientation: Floats  # (T, 4) sensor to earth (z up), w first; NaN where unknown
    moving: NDArray[np.bool_]  # (T,) the samples that count


@dataclass(frozen=True, slots=True)
class Trouble:
    """Where trouble was put into a recording. For scoring and pictures only: no estimator may read it."""

    sensor: str
    kind: str
    from_s: float
    to_s: float


@dataclass(frozen=True, slots=True)
class Recording:
    """What several sensors saw of one or more people, and the truth where it is known."""

    name: str
    about: str
    healthy_side: Side | None
    skeleton_streams: tuple[SkeletonStream, ...]
    truth: TruthStream | None
    events: tuple[Trouble, ...]
    path: Path
    origin: str = ""
    range_streams: tuple[RangeStream, ...] = ()
    imu_streams: tuple[ImuStream, ...] = ()
    orientation_truth: OrientationTruth | None = None
    arrivals_known: bool = False
    """Whether `t_received_s` of the samples says when they were received."""
