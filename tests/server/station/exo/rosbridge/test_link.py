"""The link sends the newest only, is tried again when it breaks, and never fails unseen."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

import pytest

from server.emulated.rosbridge import RosbridgePeer
from server.exoskeleton import BUILT_IN
from server.station.exo.rosbridge import wire
from server.station.exo.rosbridge.link import Link

TOPIC = BUILT_IN.rosbridge.trajectory_topic
GREETING = (wire.advertise(TOPIC), wire.subscribe(BUILT_IN.rosbridge.state_topic))


@pytest.fixture
def peer() -> Iterator[RosbridgePeer]:
    with RosbridgePeer(BUILT_IN) as peer:
        yield peer


def _link(peer: RosbridgePeer, hear: Callable[[object], object], broken: Callable[[], object] = lambda: None) -> Link:
    return Link(peer.url, GREETING, wire.unadvertise(TOPIC), hear, broken)


def _until(good: Callable[[], object]) -> None:
    end_s = time.monotonic() + 10.0
    while not good():
        assert time.monotonic() < end_s
        time.sleep(0.01)


def _trajectory(elbow_rad: float) -> bytes:
    names = tuple(joint.name for joint in BUILT_IN.joints)
    point = wire.Point((0.9, 0.4, -0.7, elbow_rad, 0.0, 0.0, 0.0), (0.0,) * 7, wire.time_of(0.02))
    return wire.publish(TOPIC, wire.JointTrajectory(names, (point,)))


def test_sr9_a_peer_that_did_not_read_gets_the_newest_and_not_all_that_came_before(peer) -> None:
    with _link(peer, lambda _: None) as link:
        link.give(_trajectory(1.0))
        _until(lambda: peer.trajectories == 1)
        peer.stall(0.3)
        for step in range(20_000):
            link.give(_trajectory(1.0 + 0.3 * step / 20_000))
        _until(lambda: abs(peer.robot.angle_rad[3] - 1.3) < 0.01)
        assert peer.trajectories < 19_000


def test_a_broken_link_is_told_once_and_made_again(peer) -> None:
    heard: list[object] = []
    broken: list[str] = []
    with _link(peer, heard.append, lambda: broken.append("broken")) as link:
        _until(lambda: heard)
        peer.drop()
        _until(lambda: broken)
        assert "was lost" in link.trouble
        heard.clear()
        _until(lambda: heard)
        assert link.trouble == ""
    assert broken == ["broken"]


def test_sr8_a_slip_of_ours_in_the_thread_is_said(peer, caplog) -> None:
    def slip(_: object) -> None:
        raise ValueError("a slip of ours")

    with _link(peer, slip) as link:
        _until(lambda: link.trouble)
        assert "fault of its own" in link.trouble
    assert "a slip of ours" in caplog.text
