"""Datagrams in: non-blocking UDP sockets, read at the tick's head, each stamped with the time of its arrival."""

from __future__ import annotations

import errno
import socket
import struct
import time
from contextlib import ExitStack
from ipaddress import IPv4Network, IPv6Network, ip_address, ip_network
from types import TracebackType
from typing import Final, Self

from fusion.errors import InputError, MachineError
from fusion.messages import Packet
from server.config import SensorsConfig
from server.station.sources.source import Losses

# Linux's numbers, which Python's socket module does not name.
SO_TIMESTAMPNS: Final = 35
SO_RXQ_OVFL: Final = 40
BUFFER_BYTES: Final = 1 << 20
ANCILLARY_BYTES: Final = 64
CLOCK_STEP_NS: Final = 1_000_000
LOOKS_AT_CLOCKS, CLOSE_LOOK_NS = 3, 20_000
SENDERS_REMEMBERED: Final = 1024
OLDEST_S: Final = 1.0
"""A stamp older than this is the wall clock's that was set while the datagram waited."""
_TIMESPEC: Final = struct.Struct("@qq")
_COUNT: Final = struct.Struct("@I")

_Received = tuple[bytes, list[tuple[int, int, bytes]], int, tuple[str, int]]


class UdpSource:
    """Every port that sensors may send to.

    The kernel stamps each datagram on arrival (`SO_TIMESTAMPNS`): measured here within 0.04 ms, where a stamp at the
    tick's head is up to 10 ms late and a thread's up to 3 ms (docs/decisions/kernel-time-stamps.md).

    Args:
        config: where to listen and how much to take (SR-15).

    Raises:
        MachineError: a port is taken or the address is not this machine's.
        InputError: an allowed sender is no address.
    """

    def __init__(self, config: SensorsConfig) -> None:
        self._config = config
        self._allowed = tuple(_network(text) for text in config.allowed_senders)
        self._known: dict[str, bool] = {}
        self._first = 0
        self._offset_ns = _monotonic_minus_wall_ns()
        self._overflows: dict[int, int] = {}
        self._oversized = 0
        self._strangers = 0
        with ExitStack() as stack:
            self._sockets = [stack.enter_context(_open(config.bind, port, name)) for name, port in config.ports.items()]
            self._stack = stack.pop_all()

    @property
    def ports(self) -> dict[str, int]:
        """Dialect to the port that is really listened on."""
        return {name: s.getsockname()[1] for name, s in zip(self._config.ports, self._sockets, strict=True)}

    @property
    def losses(self) -> Losses:
        """What was not passed on."""
        return Losses(self._oversized, self._strangers, sum(self._overflows.values()))

    def drain(self) -> list[Packet]:
        """Everything that has come since, at most `datagrams_per_tick`; the rest waits. Never blocks."""
        packets: list[Packet] = []
        left = self._config.datagrams_per_tick
        offset_ns = _monotonic_minus_wall_ns()
        # While the wall clock is being set, its stamps say nothing: then the time of reading has to do.
        stepped = abs(offset_ns - self._offset_ns) > CLOCK_STEP_NS
        self._offset_ns = offset_ns
        # Another socket is first each time, so that a flood on one port cannot starve the others.
        self._first = (self._first + 1) % len(self._sockets) if self._sockets else 0
        for i in range(len(self._sockets)):
            at = (self._first + i) % len(self._sockets)
            while left and (received := _received(self._sockets[at], self._config.datagram_bytes + 1)):
                left -= 1
                self._keep(at, received, None if stepped else offset_ns, packets)
        return packets

    def close(self) -> None:
        """Close every port."""
        self._stack.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _keep(self, at: int, received: _Received, offset_ns: int | None, packets: list[Packet]) -> None:
        payload, ancillary, _, (sender, _port) = received
        now_s = time.monotonic()
        t_s = now_s
        for _level, kind, data in ancillary:
            if kind == SO_TIMESTAMPNS and offset_ns is not None:
                seconds, nanoseconds = _TIMESPEC.unpack(data[: _TIMESPEC.size])
                stamped_s = (seconds * 1_000_000_000 + nanoseconds + offset_ns) / 1e9
                t_s = stamped_s if now_s - OLDEST_S < stamped_s < now_s else now_s
            elif kind == SO_RXQ_OVFL:
                self._overflows[at] = _COUNT.unpack(data[: _COUNT.size])[0]
        if not self._is_allowed(sender):
            self._strangers += 1
        elif len(payload) > self._config.datagram_bytes:
            self._oversized += 1
        else:
            packets.append(Packet(sender, t_s, payload))

    def _is_allowed(self, sender: str) -> bool:
        if not self._allowed:
            return True
        known = self._known.get(sender)
        if known is None:
            if len(self._known) >= SENDERS_REMEMBERED:
                self._known.clear()
            address = ip_address(sender)
            known = self._known[sender] = any(address in network for network in self._allowed)
        return known


def _received(source: socket.socket, size: int) -> _Received | None:
    try:
        return source.recvmsg(size, ANCILLARY_BYTES)
    except BlockingIOError:
        return None
    except OSError:
        return None  # an ICMP error of an earlier datagram; the next tick reads on


def _network(text: str) -> IPv4Network | IPv6Network:
    try:
        return ip_network(text, strict=False)
    except ValueError:
        raise InputError(
            f"station.sensors.allowed_senders: '{text}' is no address", "an address or a network, as 192.168.7.0/24"
        ) from None


def _open(address: str, port: int, name: str) -> socket.socket:
    opened = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        opened.bind((address, port))
    except OSError as error:
        opened.close()
        raise _cannot_listen(address, port, name, error) from None
    opened.setblocking(False)
    opened.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER_BYTES)
    for option in (SO_TIMESTAMPNS, SO_RXQ_OVFL):
        try:
            opened.setsockopt(socket.SOL_SOCKET, option, 1)
        except OSError:
            continue  # not this system's: the time of reading has to do
    return opened


def _cannot_listen(address: str, port: int, name: str, error: OSError) -> MachineError:
    key = f'station.sensors.ports."{name}"'
    if error.errno == errno.EADDRINUSE:
        return MachineError(
            f"UDP port {port} ({name}) on {address} is already in use",
            "a free port for each sensor dialect",
            f"end the other program (`ss -ulpn 'sport = :{port}'` names it), or set {key} in the configuration",
        )
    if error.errno == errno.EADDRNOTAVAIL:
        return MachineError(
            f"{address} is not an address of this machine",
            "an address of one of its interfaces",
            "set station.sensors.bind in the configuration",
        )
    return MachineError(f"UDP port {port} ({name}) on {address} cannot be opened: {error.strerror}", "", f"set {key}")


def _monotonic_minus_wall_ns() -> int:
    """The clocks' difference, from the closest of a few looks: whoever is suspended between two of them looks again."""
    looks = []
    for _ in range(LOOKS_AT_CLOCKS):
        before, wall, after = time.monotonic_ns(), time.time_ns(), time.monotonic_ns()
        looks.append((after - before, (before + after) // 2 - wall))
        if looks[-1][0] < CLOSE_LOOK_NS:
            break
    return min(looks)[1]
