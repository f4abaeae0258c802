"""What a recording holds once it has been read, whichever form it was stored in."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

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
class TruthStream:
    """Where the joints (or tags) really were."""

    t_s: Floats  # (T,) in the clock of the stream that `clock` names
    joints: tuple[str, ...]  # (N,) joint names, or tag names in a ranging recording
    positions: Floats  # (T, N, 3) m, in the primary sensor's frame; NaN where there is no truth
    clock: str = ""


@dataclass(frozen=True, slots=True)
class Trouble:
    """Where trouble was put into a recording. For scoring and pictures only: no estimator may read it."""

    sensor: str
    kind: str
    from_s: float
    to_s: float


@dataclass(frozen=True, slots=True)
class OtherStream:
    """A stream of a known kind that is listed but not loaded."""

    kind: str
    path: Path


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
    other_streams: tuple[OtherStream, ...] = ()
