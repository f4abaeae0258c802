"""How the default method's cost grows with sensors and joints."""

from __future__ import annotations

from collections.abc import Callable
from itertools import islice
from typing import Final

from fusion.benchmarks.fused_frame import fused_by, over
from fusion.benchmarks.rounds import Candidate, Timing, take_turns
from fusion.benchmarks.scene import frames
from fusion.estimation.set_membership import SetMembership

SIZES: Final = ((8, 2), (16, 2), (32, 2), (32, 1), (32, 4), (32, 8))
"""(joints, sensors)."""
FRAMES: Final = 10


def grow(rounds: int) -> dict[tuple[int, int], Timing]:
    """Timings of a fused frame by (joints, sensors)."""
    candidates = {_name(size): Candidate(_work(*size, rounds), FRAMES) for size in SIZES}
    timings = take_turns(candidates, rounds)
    return {size: timings[_name(size)] for size in SIZES}


def _name(size: tuple[int, int]) -> str:
    return f"{size[0]} joints, {size[1]} sensors"


def _work(joints: int, sensors: int, rounds: int) -> Callable[[], object]:
    enough = list(islice(frames(joints, sensors), (rounds + 1) * FRAMES))
    return over(enough, fused_by(SetMembership(joints)))
