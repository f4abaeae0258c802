"""The channels between service and station: ZeroMQ sockets on Unix sockets in a private folder, both ends.

| channel | from → to | kind |
|---|---|---|
| `wishes` | service → station | in order; only to a station that is there |
| `stop` | service → station | the same, for `Stop` and `Pain`, so that nothing can stand before them (SR-7) |
| `ticks` | station → service | newest wins, never blocks (SR-9) |
| `events` | station → service | bounded, in order, never blocks |
| `goal` | service → demonstration's sensors | newest wins |
| `pause` | station → demonstration's sensors | newest wins |
"""

from __future__ import annotations

import asyncio
import os
import tempfile
from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any

import msgspec
import zmq
import zmq.asyncio

from fusion.errors import MachineError
from server.messages import AnyEvent, AnyWish, DemoGoal, LiveTick, Pain, StationEvent, Stop, Wish

EVENTS_KEPT = 10_000
"""Events that wait for a slow service before they are dropped and counted."""
WISHES_KEPT = 1_000
LONGEST_UNIX_PATH = 107
"""Bytes; the kernel's limit for a Unix socket's path."""

_wish_decoder = msgspec.msgpack.Decoder(AnyWish)
_event_decoder: msgspec.msgpack.Decoder[AnyEvent] = msgspec.msgpack.Decoder(AnyEvent)
_tick_decoder = msgspec.msgpack.Decoder(LiveTick)
_goal_decoder = msgspec.msgpack.Decoder(DemoGoal)
_encoder = msgspec.msgpack.Encoder()


def private_folder() -> Path:
    """Make a folder for the channels that only this account may enter.

    Raises:
        MachineError: no folder with a path short enough for Unix sockets can be made.
    """
    for base in (os.environ.get("XDG_RUNTIME_DIR"), tempfile.gettempdir(), "/tmp"):  # noqa: S108 - mkdtemp is private
        if base and os.access(base, os.W_OK) and len(os.fsencode(base)) < LONGEST_UNIX_PATH - 32:
            return Path(tempfile.mkdtemp(prefix="mirrorlimb-", dir=base))
    raise MachineError(
        "There is no folder for the channels between service and station",
        f"a writable folder for temporary files whose path is shorter than {LONGEST_UNIX_PATH - 32} bytes",
        "set TMPDIR to such a folder",
    )


def encoded(message: LiveTick | StationEvent) -> bytes:
    """A tick or an event as the channels and the recording carry it (msgpack)."""
    return _encoder.encode(message)


def _address(folder: Path, name: str) -> str:
    return f"ipc://{folder / name}"


def _socket(
    context: zmq.Context[zmq.Socket[bytes]], kind: int, address: str, *, binds: bool, conflate: bool = False
) -> zmq.Socket[bytes]:
    socket = context.socket(kind)
    socket.linger = 0
    socket.setsockopt(zmq.CONFLATE, int(conflate))
    if kind == zmq.SUB:
        socket.setsockopt(zmq.SUBSCRIBE, b"")
    if binds:
        _bind(socket, address)
    else:
        socket.connect(address)
    return socket


def _bind(socket: zmq.Socket[Any], address: str) -> None:
    try:
        socket.bind(address)
    except zmq.ZMQError as error:
        raise MachineError(
            f"The channel {address} cannot be opened: {error.strerror}", "a private, writable folder"
        ) from None


def _received(socket: zmq.Socket[bytes]) -> bytes | None:
    try:
        return socket.recv(zmq.NOBLOCK)
    except zmq.Again:
        return None


def _sent(socket: zmq.Socket[bytes], message: bytes) -> bool:
    try:
        socket.send(message, zmq.NOBLOCK)
    except zmq.Again:
        return False
    return True


class StationChannels:
    """The station's end: nothing here ever blocks.

    Args:
        folder: the private folder.

    Raises:
        MachineError: a channel cannot be opened.
    """

    def __init__(self, folder: Path) -> None:
        self._context: zmq.Context[zmq.Socket[bytes]] = zmq.Context()
        self._wishes = _socket(self._context, zmq.PULL, _address(folder, "wishes"), binds=True)
        self._stop = _socket(self._context, zmq.PULL, _address(folder, "stop"), binds=True)
        self._ticks = _socket(self._context, zmq.PUB, _address(folder, "ticks"), binds=True, conflate=True)
        self._events = self._context.socket(zmq.PUSH)
        self._events.linger = 200  # ms: the last events ("closed") still leave when the station ends
        self._events.sndhwm = EVENTS_KEPT
        # The service binds this one: a connecting end queues from the start, a binding one would drop what comes early.
        self._events.connect(_address(folder, "events"))
        self._pause = _socket(self._context, zmq.PUSH, _address(folder, "pause"), binds=True, conflate=True)
        self.events_dropped = 0
        self.wishes_refused = 0

    def stops(self) -> list[Stop | Pain]:
        """Every stop and every cry of pain that has come since; read first in a tick."""
        return [wish for wish in self._drained(self._stop) if isinstance(wish, Stop | Pain)]

    def wishes(self) -> list[Wish]:
        """Every other wish that has come since, in order."""
        return self._drained(self._wishes)

    def publish(self, tick: bytes) -> None:
        """Give the newest tick (`encoded`) to whoever listens; replaces one that was not fetched."""
        _sent(self._ticks, tick)

    def tell(self, event: bytes) -> None:
        """Queue an event (`encoded`); dropped and counted where the queue is full."""
        if not _sent(self._events, event):
            self.events_dropped += 1

    def pause_demonstration(self, paused: bool) -> None:
        """Tell the demonstration's sensors to be silent or to go on."""
        _sent(self._pause, b"\1" if paused else b"\0")

    def close(self) -> None:
        """Close every channel."""
        for socket in (self._wishes, self._stop, self._ticks, self._events, self._pause):
            socket.close()
        self._context.term()

    def _drained(self, socket: zmq.Socket[bytes]) -> list[Wish]:
        wishes: list[Wish] = []
        while len(wishes) < WISHES_KEPT and (message := _received(socket)) is not None:
            try:
                wishes.append(_wish_decoder.decode(message))
            except msgspec.MsgspecError:
                self.wishes_refused += 1
        return wishes


class ServiceChannels:
    """The service's end, for asyncio. Make it inside the running loop, before the station starts.

    Args:
        folder: the private folder, as given to the station.

    Raises:
        MachineError: a channel cannot be opened.
    """

    def __init__(self, folder: Path) -> None:
        self._context = zmq.asyncio.Context()
        self._plain: zmq.Context[zmq.Socket[bytes]] = zmq.Context.shadow(self._context)
        self._wishes = self._outgoing(folder, "wishes")
        self._stop = self._outgoing(folder, "stop")
        self._goal = _socket(self._plain, zmq.PUSH, _address(folder, "goal"), binds=False, conflate=True)
        self._ticks = self._context.socket(zmq.SUB)
        self._ticks.setsockopt(zmq.CONFLATE, 1)
        self._ticks.setsockopt(zmq.SUBSCRIBE, b"")
        self._ticks.connect(_address(folder, "ticks"))
        self._events = self._context.socket(zmq.PULL)
        self._events.rcvhwm = EVENTS_KEPT
        _bind(self._events, _address(folder, "events"))
        self._last_index = -1
        self.ticks_missed = 0
        """Ticks that a newer one replaced before they were fetched."""

    def send(self, wish: Wish) -> bool:
        """Send a wish; False where no station is there to take it. Never waits, and nothing is kept for later: an
        old "enable" must not reach a station that starts afterwards.
        """
        return _sent(self._stop if isinstance(wish, Stop | Pain) else self._wishes, _encoder.encode(wish))

    def steer_demonstration(self, goal: DemoGoal) -> None:
        """Say where the virtual patient should reach now; newest wins."""
        _sent(self._goal, _encoder.encode(goal))

    async def tick(self) -> LiveTick:
        """The newest tick; waits for one that has not been fetched."""
        tick = _tick_decoder.decode(await self._ticks.recv())
        if self._last_index >= 0:
            self.ticks_missed += max(0, tick.index - self._last_index - 1)
        self._last_index = tick.index
        return tick

    async def ticks(self) -> AsyncIterator[LiveTick]:
        """Ticks as they come, the newest each time, for ever."""
        while True:
            yield await self.tick()

    async def event(self) -> AnyEvent:
        """The next event, in order."""
        return _event_decoder.decode(await self._events.recv())

    async def events(self) -> AsyncIterator[AnyEvent]:
        """Events in order, for ever."""
        while True:
            yield await self.event()

    async def connected(self, timeout_s: float) -> bool:
        """Wait until a station can take wishes, and a stop."""
        end = asyncio.get_running_loop().time() + timeout_s
        while not all(socket.poll(0, zmq.POLLOUT) for socket in (self._wishes, self._stop)):
            if asyncio.get_running_loop().time() > end:
                return False
            await asyncio.sleep(0.01)
        return True

    def close(self) -> None:
        """Close every channel."""
        for socket in (self._wishes, self._stop, self._goal, self._ticks, self._events):
            socket.close(linger=0)
        self._context.term()

    def _outgoing(self, folder: Path, name: str) -> zmq.Socket[bytes]:
        socket = self._plain.socket(zmq.PUSH)
        socket.linger = 0
        socket.sndhwm = WISHES_KEPT
        socket.setsockopt(zmq.IMMEDIATE, 1)
        socket.connect(_address(folder, name))
        return socket


class DemonstrationChannels:
    """The end of the demonstration's own sensors.

    Args:
        folder: the private folder.

    Raises:
        MachineError: a channel cannot be opened.
    """

    def __init__(self, folder: Path) -> None:
        self._context: zmq.Context[zmq.Socket[bytes]] = zmq.Context()
        self._goal = _socket(self._context, zmq.PULL, _address(folder, "goal"), binds=True, conflate=True)
        self._pause = _socket(self._context, zmq.PULL, _address(folder, "pause"), binds=False, conflate=True)
        self.paused = False

    def goal(self) -> DemoGoal | None:
        """The newest goal, if one has come since."""
        message = _received(self._goal)
        try:
            return None if message is None else _goal_decoder.decode(message)
        except msgspec.MsgspecError:
            return None

    def is_paused(self) -> bool:
        """Whether the station asked for silence."""
        message = _received(self._pause)
        if message is not None:
            self.paused = message == b"\1"
        return self.paused

    def close(self) -> None:
        """Close both channels."""
        self._goal.close()
        self._pause.close()
        self._context.term()
