"""What makes the station itself hold: a service that has gone, a loop that is late too often."""

from __future__ import annotations

from hand_cranked import HandCranked

from server.messages import DriveState, Enable, Resume


def _engaged() -> HandCranked:
    crank = HandCranked()
    assert crank.open().accepted
    crank.run(4.0)
    assert crank.ask(Enable).accepted, crank.last.blockers
    assert crank.run(0.1).state is DriveState.ENGAGED
    return crank


def test_sr8_a_service_that_has_gone_holds_in_the_very_tick_whatever_it_had_sent() -> None:
    crank = _engaged()
    crank.loop.lose_service()
    tick = crank.tick()  # with a heartbeat that was still on its way
    assert tick.state is DriveState.HOLD
    assert "service has gone" in tick.reason
    assert "gone" in crank.ask(Resume).reason


def test_sr9_late_ticks_are_counted_and_too_many_hold_until_a_person_resumes() -> None:
    crank = _engaged()
    crank.loop.count_overruns(20, crank.now_s)
    assert crank.tick().state is DriveState.ENGAGED
    assert crank.last.timing.overruns == 20
    crank.loop.count_overruns(9, crank.now_s)
    held = crank.tick()
    assert held.state is DriveState.HOLD
    assert "too busy" in held.reason
    assert "too busy" in crank.ask(Resume).reason
    assert crank.run(1.2).state is DriveState.HOLD  # calm again, and still nothing moves by itself
    assert crank.ask(Resume).accepted
    assert crank.last.state is DriveState.ENGAGED
