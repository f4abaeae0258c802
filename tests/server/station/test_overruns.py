"""Late ticks are counted for ever and hold only while there are many."""

from __future__ import annotations

from server.station.overruns import WINDOW_S, Overruns

RATE_HZ = 100


def test_sr9_a_late_tick_is_counted_and_does_not_hold() -> None:
    overruns = Overruns().counted(3, 10.0)
    assert overruns.in_all == 3
    assert overruns.fault(RATE_HZ, 10.0) == ""


def test_sr9_many_late_ticks_within_a_second_hold_and_say_how_many() -> None:
    overruns = Overruns()
    for k in range(4):
        overruns = overruns.counted(9, 10.0 + 0.1 * k)
    assert "36 of the control loop's last 100 ticks" in overruns.fault(RATE_HZ, 10.4)
    assert overruns.fault(RATE_HZ, 10.3 + WINDOW_S) == ""
    assert overruns.in_all == 36


def test_sr9_what_is_remembered_does_not_grow() -> None:
    overruns = Overruns()
    for k in range(1000):
        overruns = overruns.counted(1, 0.05 * k)
    assert overruns.in_all == 1000
    assert len(overruns.recent) <= 21
