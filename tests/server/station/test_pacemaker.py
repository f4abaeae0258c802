"""The schedule is absolute; what the watch learns acts in the tick that follows it."""

from __future__ import annotations

import time

from server.station import pacemaker

RATE_HZ = 200


def test_sr9_slots_that_passed_are_counted_and_not_made_up_for() -> None:
    steps: list[float] = []
    missed: list[int] = []

    def step(now_s: float) -> None:
        steps.append(now_s)
        if len(steps) == 1:
            time.sleep(0.051)

    pacemaker.keep_time(step, lambda slots, _: missed.append(slots), RATE_HZ, lambda: len(steps) < 3)
    assert len(steps) == 3
    assert sum(missed) >= 9  # ten slots went by in the first step, and the second step took the last of them


def test_sr8_the_watch_is_asked_after_the_wait_and_directly_before_the_tick() -> None:
    order: list[str] = []
    asked_s: list[float] = []

    def goes_on() -> bool:
        order.append("asked")
        asked_s.append(time.monotonic())
        return len(asked_s) < 4

    begun_s = time.monotonic()
    pacemaker.keep_time(lambda _: order.append("step"), lambda *_: None, RATE_HZ, goes_on)
    assert order == [*["asked", "step"] * 3, "asked"]
    assert all(at_s >= begun_s + k / RATE_HZ for k, at_s in enumerate(asked_s))
