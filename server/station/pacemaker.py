"""Calls the loop's step on a fixed, absolute schedule, and counts the ticks that were missed."""

from __future__ import annotations

import gc
import os
import sys
import time
from collections.abc import Callable
from contextlib import suppress

PRIORITY = 20
SWITCH_S = 0.0005
"""How long another thread (the recorder) may keep the interpreter while a tick is due."""


def prepare() -> bool:
    """Make this process fit to keep time.

    What lives now is taken out of the garbage collector's sight, threads give way sooner, and where the system grants
    it the loop's thread gets real-time priority; its children and other threads do not.

    Returns:
        Whether real-time priority was granted.
    """
    gc.collect()
    gc.freeze()
    sys.setswitchinterval(SWITCH_S)
    with suppress(AttributeError, OSError):
        os.sched_setscheduler(0, os.SCHED_FIFO | os.SCHED_RESET_ON_FORK, os.sched_param(PRIORITY))
        return True
    return False


def keep_time(
    step: Callable[[float], object],
    missed: Callable[[int], None],
    rate_hz: int,
    goes_on: Callable[[], bool],
) -> None:
    """Call `step(now)` at every multiple of the period while `goes_on()`.

    A late tick is not made up for: the schedule stays, and the slots that passed are counted (SR-9).

    Args:
        step: one tick.
        missed: told how many slots passed.
        rate_hz: ticks a second.
        goes_on: asked before each tick.
    """
    period_s = 1.0 / rate_hz
    due_s = time.monotonic()
    while goes_on():
        late_s = time.monotonic() - due_s
        if late_s < 0:
            time.sleep(-late_s)
        elif late_s > period_s:
            slots = int(late_s / period_s)
            missed(slots)
            due_s += slots * period_s
        step(time.monotonic())
        due_s += period_s
