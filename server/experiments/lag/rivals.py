"""Other filters on the estimator's angles, bare and after the same limiter, and ours among them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Final

from fusion.messages import Floats
from server.experiments.lag.course import DEVICE, Course
from server.experiments.lag.filters import limited, median, one_euro
from server.experiments.lag.response import JOINTS
from server.experiments.lag.scores import Score, score

OURS: Final = "ours"


@dataclass(frozen=True, slots=True)
class Rival:
    """One setting of a filter."""

    family: str
    setting: str
    filtered: Callable[[Floats], Floats]


@dataclass(frozen=True, slots=True)
class Told:
    """Its scores, by the angle's name."""

    family: str
    setting: str
    bare: dict[str, Score]
    limited: dict[str, Score]


def _as_seen(angle_rad: Floats) -> Floats:
    return angle_rad


RIVALS: Final = (
    Rival("none", "–", _as_seen),
    *(Rival("median", f"{t_s} s", partial(median, window_s=t_s)) for t_s in (0.1, 0.2, 0.3, 0.5, 0.8)),
    *(
        Rival("One Euro", f"{hz} Hz, {beta}", partial(one_euro, least_hz=hz, beta=beta))
        for hz, beta in ((0.3, 0.5), (0.5, 0.5), (1.0, 0.5), (1.0, 2.0), (2.0, 1.0))
    ),
)


def all_told(run: Course) -> tuple[Told, ...]:
    """Every rival on one course, ours the last."""
    return (*(_told(rival, run) for rival in RIVALS), _ours(run))


def _told(rival: Rival, run: Course) -> Told:
    bare, after = {}, {}
    for name, joint in JOINTS.items():
        truth, out = run.seen.truth_rad[:, joint], rival.filtered(run.seen.estimated_rad[:, joint])
        bare[name] = score(out, truth)
        after[name] = score(limited(out, DEVICE[joint]), truth)
    return Told(rival.family, rival.setting, bare, after)


def _ours(run: Course) -> Told:
    truth, calm = run.seen.truth_rad, run.whole.calm_rad
    bare = {name: score(calm[:, joint], truth[:, joint]) for name, joint in JOINTS.items()}
    return Told(OURS, "as it is", bare, run.scores(run.whole))
