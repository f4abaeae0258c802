"""The default method with some of its constants changed, in a process of its own.

Constants are compiled into the kernels, so a changed one needs a fresh process that keeps nothing of what it compiles.
Nothing is imported here that compiles, so that the other process may say first where to keep it.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from fusion.messages import AlignedSample, Floats, FusedFrame, States

ASKED, ANSWER = "asked-{}.npz", "answer-{}.npz"


@dataclass(frozen=True, slots=True)
class Change:
    """One constant of `fusion.estimation` that has another value."""

    module: str
    """Where it stands, and the only one that uses it."""
    constant: str
    value: float


@dataclass(frozen=True, slots=True)
class Watched:
    """N aligned samples in time order, and T instants at which to tell the body."""

    sample_s: Floats  # (N,)
    sensor: NDArray[np.int64]  # (N,) whose they are
    positions_in_room: Floats  # (N, 25, 3) m
    state: States  # (N, 25)
    lens_in_room: Floats  # (N, 3) m
    rotation_sensor_to_room: Floats  # (N, 3, 3)
    t_s: Floats  # (T,)

    @staticmethod
    def of(samples: Sequence[AlignedSample], t_s: Floats) -> Watched:
        """The samples in arrays."""
        names = sorted({sample.sensor for sample in samples})
        return Watched(
            np.array([sample.t_s for sample in samples]),
            np.array([names.index(sample.sensor) for sample in samples]),
            np.array([sample.positions_in_room for sample in samples]),
            np.array([sample.state for sample in samples]),
            np.array([sample.lens_in_room for sample in samples]),
            np.array([sample.rotation_sensor_to_room for sample in samples]),
            t_s,
        )

    def sample(self, n: int) -> AlignedSample:
        """The n-th sample."""
        t_s = float(self.sample_s[n])
        where = self.lens_in_room[n], self.rotation_sensor_to_room[n]
        return AlignedSample(f"{self.sensor[n]}", t_s, t_s, self.positions_in_room[n], self.state[n], *where)


@dataclass(frozen=True, slots=True)
class Told:
    """What the method told at those instants; joints never seen are NaN."""

    positions: Floats  # (T, 25, 3) m
    bound_m: Floats  # (T, 25)


def told_with(changes: Sequence[Change], watched: Sequence[Watched]) -> tuple[Told, ...]:
    """Follow each of the watched bodies with the constants changed.

    Raises:
        subprocess.CalledProcessError: a constant is not there.
    """
    with TemporaryDirectory() as name:
        folder = Path(name)
        for k, each in enumerate(watched):
            np.savez(folder / ASKED.format(k), **asdict(each))
        said = json.dumps([asdict(change) for change in changes])
        command = (sys.executable, "-m", __name__, name, said)
        subprocess.run(command, check=True, env=os.environ | {"NUMBA_CACHE_DIR": name})  # noqa: S603 - ourselves
        return tuple(Told(**_arrays(folder / ANSWER.format(k))) for k in range(len(watched)))


def _arrays(file: Path) -> dict[str, np.ndarray]:
    with np.load(file) as arrays:
        return dict(arrays)


def _change(changes: Sequence[Change]) -> None:
    for change in changes:
        module = import_module(f"fusion.estimation.{change.module}")
        if not hasattr(module, change.constant):
            raise AttributeError(f"fusion.estimation.{change.module} has no '{change.constant}'")
        setattr(module, change.constant, change.value)


def _told(watched: Watched) -> Told:
    from fusion.estimation.set_membership import SetMembership
    from fusion.steady import follow

    estimator, n, frames = SetMembership(), 0, list[FusedFrame]()
    for t_s in watched.t_s.tolist():
        while n < len(watched.sample_s) and watched.sample_s[n] <= t_s:
            estimator.update(watched.sample(n))
            n += 1
        frames.append(follow(frames[-1] if frames else None, estimator.frame(t_s)))
    return Told(np.array([f.positions_in_room for f in frames]), np.array([f.bound_m for f in frames]))


def main(name: str, said: str) -> None:
    """Answer what was asked in the folder `name`, with the changes `said`."""
    _change([Change(**each) for each in json.loads(said)])
    folder = Path(name)
    for k in range(len(list(folder.glob(ASKED.format("*"))))):
        told = _told(Watched(**_arrays(folder / ASKED.format(k))))
        np.savez(folder / ANSWER.format(k), **asdict(told))


if __name__ == "__main__":
    main(*sys.argv[1:])
