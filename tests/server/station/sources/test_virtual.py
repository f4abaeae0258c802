"""The demonstration's sensors: real datagrams from two addresses, for either side, and silence when asked."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from fusion.formats.decoder import Decoder
from fusion.messages import SkeletonSample
from fusion.skeleton import INDEX, Side
from server.config import SensorsConfig
from server.messages import DemoGoal
from server.station.demonstration import ADDRESSES
from server.station.sources.udp import UdpSource
from server.station.sources.virtual import STEP_S, VirtualStage


@pytest.fixture
def source() -> Iterator[UdpSource]:
    with UdpSource(SensorsConfig(ports={"any": 0}, datagrams_per_tick=1000)) as opened:
        yield opened


@pytest.fixture
def stage(source: UdpSource) -> Iterator[VirtualStage]:
    made = VirtualStage("127.0.0.1", source.ports["any"])
    yield made
    made.close()


def _seen(stage: VirtualStage, source: UdpSource, seconds: float, speaking: bool = True) -> list[SkeletonSample]:
    decoder, samples = Decoder(), []
    for _ in range(round(seconds / STEP_S)):
        stage.step(STEP_S, speaking)
        for packet in source.drain():
            samples += decoder.feed(packet)
    return samples


def test_both_sensors_send_about_thirty_frames_a_second(stage: VirtualStage, source: UdpSource) -> None:
    samples = _seen(stage, source, 2.0)
    for address in ADDRESSES:
        assert 50 <= sum(sample.sensor == address for sample in samples) <= 62


def test_a_paused_stage_lives_on_in_silence(stage: VirtualStage, source: UdpSource) -> None:
    assert _seen(stage, source, 1.0, speaking=False) == []
    assert _seen(stage, source, 0.5)


@pytest.mark.parametrize("side", Side)
def test_the_healthy_hand_goes_where_it_is_asked_to(stage: VirtualStage, source: UdpSource, side: Side) -> None:
    outward = 0.3 if side is Side.RIGHT else -0.3
    _seen(stage, source, 0.5)
    rest = _seen(stage, source, 0.5)[-1]
    stage.take(DemoGoal(hand_in_trunk=(outward, 0.1, -0.3), healthy_side=side))
    reached = _seen(stage, source, 3.0)
    hand = INDEX[f"Hand{side.suffix}"]
    at_rest, at_goal = (
        next(s for s in samples if s.sensor == ADDRESSES[0]).positions_in_sensor[hand]
        for samples in ([rest, *reached], reversed(reached))
    )
    assert at_goal[1] > at_rest[1] + 0.15
