"""Datagrams in: stamped on arrival, capped, refused by size and sender (SR-15)."""

from __future__ import annotations

import socket
import time
from collections.abc import Iterator

import pytest

from fusion.errors import InputError, MachineError
from fusion.messages import Packet
from server.config import SensorsConfig
from server.station.sources import udp
from server.station.sources.source import Losses
from server.station.sources.udp import UdpSource


def _config(**change: object) -> SensorsConfig:
    return SensorsConfig(**{"ports": {"any": 0}, **change})  # type: ignore[arg-type]  # any field


@pytest.fixture
def sender() -> Iterator[socket.socket]:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as opened:
        opened.bind(("127.0.0.3", 0))
        yield opened


def _target(source: UdpSource) -> tuple[str, int]:
    return "127.0.0.1", source.ports["any"]


def _all(source: UdpSource, count: int) -> list[Packet]:
    packets: list[Packet] = []
    while len(packets) < count:
        packets += source.drain()
    return packets


def test_a_datagram_carries_its_senders_address_and_the_time_of_its_arrival(sender: socket.socket) -> None:
    early_s = []
    with UdpSource(_config()) as source:
        for _ in range(5):
            before = time.monotonic()
            sender.sendto(b"hello", _target(source))
            time.sleep(0.05)  # reading late does not make it younger
            read = time.monotonic()
            (packet,) = _all(source, 1)
            assert (packet.stream, packet.payload) == ("127.0.0.3", b"hello")
            assert before - 0.001 <= packet.t_received_s
            early_s.append(read - packet.t_received_s)
    # Where the machine's wall clock is set in between, the time of reading is used: rarely, and never for all.
    assert max(early_s) > 0.04


def test_sr8_while_the_wall_clock_is_being_set_the_time_of_reading_is_used(
    sender: socket.socket, monkeypatch: pytest.MonkeyPatch
) -> None:
    with UdpSource(_config()) as source:
        real = udp._monotonic_minus_wall_ns
        monkeypatch.setattr(udp, "_monotonic_minus_wall_ns", lambda: real() - 3600 * 10**9)
        before = time.monotonic()
        sender.sendto(b"x", _target(source))
        (packet,) = _all(source, 1)
        assert before <= packet.t_received_s <= time.monotonic()


def test_sr9_no_more_than_the_cap_is_read_in_one_tick_and_nothing_is_lost(sender: socket.socket) -> None:
    with UdpSource(_config(datagrams_per_tick=10)) as source:
        for number in range(25):
            sender.sendto(b"%d" % number, _target(source))
        time.sleep(0.02)
        sizes = [len(source.drain()) for _ in range(4)]
    assert sizes == [10, 10, 5, 0]


def test_sr15_what_comes_faster_than_it_is_read_is_counted(sender: socket.socket) -> None:
    with UdpSource(_config(datagrams_per_tick=100_000)) as source:
        for _ in range(20_000):
            sender.sendto(b"x" * 1000, _target(source))
        taken = len(source.drain())
        sender.sendto(b"x", _target(source))
        taken += len(_all(source, 1))
        assert taken + source.losses.overflowed == 20_001
        assert source.losses.in_all == source.losses.overflowed > 0


def test_sr15_an_oversized_datagram_is_refused_and_counted(sender: socket.socket) -> None:
    with UdpSource(_config(datagram_bytes=100)) as source:
        sender.sendto(b"x" * 101, _target(source))
        sender.sendto(b"x" * 100, _target(source))
        assert [len(packet.payload) for packet in _all(source, 1)] == [100]
        assert source.losses == Losses(oversized=1)


def test_sr15_only_allowed_senders_are_read(sender: socket.socket) -> None:
    with (
        UdpSource(_config(allowed_senders=("127.0.0.3/32", "10.0.0.0/8"))) as source,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as stranger,
    ):
        stranger.bind(("127.0.0.4", 0))
        stranger.sendto(b"no", _target(source))
        sender.sendto(b"yes", _target(source))
        assert [packet.payload for packet in _all(source, 1)] == [b"yes"]
        assert source.losses == Losses(strangers=1)


def test_a_port_in_use_is_named_with_what_to_do() -> None:
    with UdpSource(_config()) as source:
        port = source.ports["any"]
        with pytest.raises(MachineError) as caught:
            UdpSource(_config(ports={"k2s": port}))
    for words in (str(port), "k2s", "already in use", 'station.sensors.ports."k2s"'):
        assert words in str(caught.value)


def test_an_address_of_another_machine_is_named() -> None:
    with pytest.raises(MachineError, match=r"203\.0\.113\.1 is not an address of this machine"):
        UdpSource(_config(bind="203.0.113.1"))


def test_an_allowed_sender_that_is_no_address_is_named() -> None:
    with pytest.raises(InputError, match="'kinect' is no address"):
        UdpSource(_config(allowed_senders=("kinect",)))


def test_a_port_that_could_not_be_opened_leaves_none_open() -> None:
    with UdpSource(_config()) as probe:
        free = probe.ports["any"]
    with UdpSource(_config()) as taken, pytest.raises(MachineError):
        UdpSource(_config(ports={"first": free, "second": taken.ports["any"]}))
    UdpSource(_config(ports={"first": free})).close()
