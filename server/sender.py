"""Sends skeleton samples as a real sender would: OSC over UDP, in real time, each sensor from an address of its own."""

from __future__ import annotations

import ipaddress
import socket
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, suppress
from dataclasses import dataclass, replace
from types import TracebackType
from typing import Self

from fusion.errors import InputError, MachineError
from fusion.formats.dialect import Dialect
from fusion.messages import SkeletonSample
from fusion.recording.reader import Recording

_FRAME_S = 1 / 30


@dataclass(frozen=True, slots=True)
class Destination:
    """Where datagrams go."""

    host: str
    port: int


def parse_destination(text: str, default_port: int) -> Destination:
    """A destination from "HOST", "HOST:PORT" or ":PORT"; raises InputError on anything else."""
    host, colon, port = text.strip().rpartition(":") if ":" in text else (text.strip(), "", "")
    if not colon:
        port = str(default_port)
    if not (port.isascii() and port.isdigit() and 0 < int(port) < 65536) or ":" in host or " " in host:
        raise InputError(f"'{text}' is no destination", "HOST or HOST:PORT, as 127.0.0.1:12345", "check --to")
    return Destination(host or "127.0.0.1", int(port))


class Sender:
    """One UDP socket per sensor. To this machine, sensor k sends from 127.0.0.(k+1): sensors are told apart by address.

    Args:
        destination: where to send.
        sensors: how many sensors.
        dialect: how to say it.

    Raises:
        InputError: the host is unknown. MachineError: an address cannot be used, or sending fails.
    """

    def __init__(self, destination: Destination, sensors: int, dialect: Dialect) -> None:
        self.destination, self._dialect = destination, dialect
        self.unheard = 0
        """Datagrams that the destination's machine turned away because nobody listens."""
        self._sequences = [0] * sensors
        address = _resolve(destination)
        with ExitStack() as stack:
            self._sockets = [stack.enter_context(_open(address, destination.port, k)) for k in range(sensors)]
            self._stack = stack.pop_all()

    def send(self, sensor: int, sample: SkeletonSample) -> None:
        """Send one sample of one sensor, as all its datagrams."""
        datagrams = self._dialect.encode(sample, self._sequences[sensor])
        self._sequences[sensor] += 1
        for datagram in datagrams:
            self._send(self._sockets[sensor], datagram)

    def _send(self, channel: socket.socket, datagram: bytes) -> None:
        try:
            channel.send(datagram)
        except ConnectionRefusedError:
            # This tells of an earlier datagram; the present one has not been sent yet.
            self.unheard += 1
            with suppress(ConnectionRefusedError):
                channel.send(datagram)
        except OSError as error:
            where = f"{self.destination.host}:{self.destination.port}"
            remedy = "check the network and --to"
            raise MachineError(f"cannot send to {where} ({error.strerror})", "a reachable machine", remedy) from None

    def close(self) -> None:
        """Close the sockets."""
        self._stack.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def _resolve(destination: Destination) -> str:
    try:
        found = socket.getaddrinfo(destination.host, destination.port, socket.AF_INET, socket.SOCK_DGRAM)
    except (OSError, UnicodeError):
        raise InputError(
            f"the host '{destination.host}' is unknown", "a name or an IPv4 address", "check --to"
        ) from None
    return str(found[0][4][0])


def _open(address: str, port: int, sensor: int) -> socket.socket:
    channel = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    source = f"127.0.0.{sensor + 1}" if ipaddress.ip_address(address).is_loopback else ""
    try:
        channel.bind((source, 0))
        channel.connect((address, port))
    except OSError as error:
        channel.close()
        remedy = f"on macOS: sudo ifconfig lo0 alias {source}" if source else "check the network and --to"
        raise MachineError(f"cannot send from {source or 'here'} to {address} ({error.strerror})", "", remedy) from None
    return channel


# ---------------------------------------------------------------- what leaves when


@dataclass(frozen=True, slots=True)
class Departure:
    """A sample that leaves `after_s` after the start."""

    after_s: float
    sensor: int
    sample: SkeletonSample


def departures(recording: Recording, loop: bool = False) -> Iterator[Departure]:
    """A recording's samples of all sensors in the order in which they were received; with `loop` for ever.

    In a loop the sensors' clocks go on, as a real sensor's would.
    """
    streams = enumerate(stream.samples for stream in recording.skeleton_streams)
    once = sorted(((k, sample) for k, samples in streams for sample in samples), key=lambda pair: pair[1].t_received_s)
    if not once:
        what = f"{recording.path} has no skeleton frames"
        raise InputError(what, "a recording with at least one", "choose another recording")
    first_s, length_s = once[0][1].t_received_s, duration_s(recording) + _FRAME_S
    shift_s = 0.0
    while True:
        for sensor, sample in once:
            shifted = replace(sample, t_s=sample.t_s + shift_s)
            yield Departure(sample.t_received_s - first_s + shift_s, sensor, shifted)
        if not loop:
            return
        shift_s += length_s


def duration_s(recording: Recording) -> float:
    """Time from the first received frame to the last; 0 without frames."""
    times = [sample.t_received_s for stream in recording.skeleton_streams for sample in stream.samples]
    return max(times) - min(times) if times else 0.0


def send_in_time(
    leaving: Iterator[Departure], sender: Sender, speed: float = 1.0, told: Callable[[float], None] = lambda _: None
) -> None:
    """Send everything when its time comes. Waits are counted from the start, so that they never add up to a drift.

    Args:
        leaving: what to send.
        sender: where to.
        speed: 1 = real time.
        told: called with each departure's time in seconds, for a progress bar.
    """
    start_s = time.monotonic()
    for departure in leaving:
        wait_s = start_s + departure.after_s / speed - time.monotonic()
        if wait_s > 0:
            time.sleep(wait_s)
        sender.send(departure.sensor, departure.sample)
        told(departure.after_s)
