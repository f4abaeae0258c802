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


def ask_for_priority() -> bool:
    """Real-time priority, where the system grants it, for this thread and all that it will start.

    The recorder's thread and ZeroMQ's need it too: a thread of ordinary priority that is suspended by other programs
    while it holds the interpreter's lock would hold up the loop.
    """
    with suppress(AttributeError, OSError):
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(PRIORITY))
        return True
    return False


def give_up_priority() -> None:
    """Ordinary priority again; for children that inherited more."""
    with suppress(AttributeError, OSError):
        os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))


def settle() -> None:
    """Take what lives now out of the garbage collector's sight, and let threads give way sooner."""
    gc.collect()
    gc.freeze()
    sys.setswitchinterval(SWITCH_S)


def keep_time(
    step: Callable[[float], object],
    missed: Callable[[int, float], None],
    rate_hz: int,
    goes_on: Callable[[], bool],
) -> None:
    """Call `step(now)` at every multiple of the period while `goes_on()`, which is asked directly before it.

    A late tick is not made up for: the schedule stays, and the slots that passed are counted (SR-9).

    Args:
        step: one tick.
        missed: told how many slots passed, and when.
        rate_hz: ticks a second.
        goes_on: what it learns (the service has gone) holds in the very tick that follows.
    """
    period_s = 1.0 / rate_hz
    due_s = time.monotonic()
    while True:
        early_s = due_s - time.monotonic()
        if early_s > 0:
            time.sleep(early_s)
        if not goes_on():
            return
        now_s = time.monotonic()
        slots = int((now_s - due_s) / period_s)
        if slots:
            missed(slots, now_s)
            due_s += slots * period_s
        step(now_s)
        due_s += period_s
