"""An emulated rosbridge server on loopback with a robot behind it, which can be made to fail.

Protocol: rosbridge v2 over WebSocket, as far as `server.station.exo.rosbridge` and anybody's first tries need it. The
messages are read and written here as plain JSON and not by the drive's own forms, so that each checks the other.
"""

from __future__ import annotations

import asyncio
import json
import threading
import time
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import dataclass, field
from types import TracebackType
from typing import Any, Self
from urllib.parse import urlsplit

from websockets.asyncio.server import ServerConnection, broadcast, serve
from websockets.exceptions import ConnectionClosed

from fusion.errors import InputError, MachineError
from server.emulated.robot import EmulatedRobot
from server.exoskeleton import Exoskeleton

RATE_HZ = 100
USUAL_PORT = 80
"""Of a url that names none."""
CLOCK_AHEAD_S = 1_000_000.0
"""The robot's clock is another than ours."""
LAST_ACCEPTED_S = 0.1
"""Somebody who came in the very moment of closing is turned away within this time; without it the socket stays open."""
LOOPBACK = "127.0.0.1"
USED = ("advertise", "unadvertise", "publish", "subscribe", "unsubscribe")
COMMANDS = "silent, frozen, deaf, lag SECONDS, lie JOINT RADIANS, complain WORDS, stall SECONDS, drop, well"


@dataclass(slots=True)
class Failing:
    """How it fails; as made, it is well."""

    silent: bool = False
    """No joint states."""
    frozen: bool = False
    """The same joint state again and again."""
    deaf: bool = False
    """Trajectories are not followed."""
    lag_s: float = 0.0
    """Joint states come so late."""
    lie_rad: dict[str, float] = field(default_factory=dict)
    """What is added to a joint's measured angle."""


class RosbridgePeer:
    """The server in a thread of its own, opened and closed in a `with`.

    Args:
        exoskeleton: the robot's joints, and the topics.
        port: to listen on; 0 = any free one.
    """

    def __init__(self, exoskeleton: Exoskeleton, port: int = 0) -> None:
        self._settings, self._port = exoskeleton.rosbridge, port
        self.robot = EmulatedRobot(exoskeleton)
        self.failing = Failing()
        self.operations: list[str] = []
        """What the newest client asked for, in order, trajectories left out."""
        self.trajectories = 0
        """Trajectories that were followed."""
        self.refusals: list[str] = []
        """What was wrong with the others."""
        self._connections: set[ServerConnection] = set()
        self._subscribed: set[ServerConnection] = set()
        self._under_way: list[tuple[float, str]] = []
        self._newest = ""
        self._ready: Future[int] = Future()
        self._thread = threading.Thread(target=lambda: asyncio.run(self._live()), name="emulated rosbridge")

    def __enter__(self) -> Self:
        """Start.

        Raises:
            MachineError: the port is taken.
        """
        self._thread.start()
        self._port = self._ready.result()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._loop.call_soon_threadsafe(self._end.set)
        self._thread.join()

    @property
    def url(self) -> str:
        """Where it listens."""
        return f"ws://{LOOPBACK}:{self._port}"

    def drop(self) -> None:
        """Break every connection without a word."""
        self._loop.call_soon_threadsafe(self._abort)

    def stall(self, seconds: float) -> None:
        """Stand still altogether: nothing is read, answered or sent."""
        self._loop.call_soon_threadsafe(time.sleep, seconds)

    def obey(self, line: str) -> str:
        """Fail as a typed line says; what was understood, or what could have been."""
        words = line.split()
        try:
            return self._obeyed(words[0], words[1:])
        except (IndexError, ValueError, KeyError):
            return f"one of: {COMMANDS}"

    def _obeyed(self, word: str, rest: list[str]) -> str:
        if word == "well":
            self.failing = Failing()
        elif word == "drop":
            self.drop()
        elif word == "complain":
            self._loop.call_soon_threadsafe(self._broadcast, json.dumps(_complaint(" ".join(rest))))
        elif word == "stall":
            self.stall(float(rest[0]))
        elif word == "lag":
            self.failing.lag_s = float(rest[0])
        elif word == "lie":
            *name, value = rest
            self.failing.lie_rad = {self.robot.names[self.robot.names.index(" ".join(name))]: float(value)}
        else:
            setattr(self.failing, {"silent": "silent", "frozen": "frozen", "deaf": "deaf"}[word], True)
        return f"{word}: {self.failing}"

    # ---------------------------------------------------------------- in its thread

    async def _live(self) -> None:
        self._loop, self._end = asyncio.get_running_loop(), asyncio.Event()
        try:
            server = await serve(self._talk, LOOPBACK, self._port, compression=None, close_timeout=0.2)
        except OSError as error:
            self._ready.set_exception(
                MachineError(f"Port {self._port} cannot be used: {error.strerror}", "a free port", "another url")
            )
            return
        async with server:
            self._ready.set_result(next(iter(server.sockets)).getsockname()[1])
            telling = asyncio.create_task(self._tell())
            await self._end.wait()
            telling.cancel()
        await asyncio.sleep(LAST_ACCEPTED_S)

    async def _talk(self, connection: ServerConnection) -> None:
        self._connections.add(connection)
        self.operations = []
        with suppress(ConnectionClosed):
            async for message in connection:
                wrong = self._told(connection, message)
                if wrong:
                    await connection.send(json.dumps(_complaint(wrong)))
        self._connections.discard(connection)
        self._subscribed.discard(connection)

    def _told(self, connection: ServerConnection, message: str | bytes) -> str:
        """One message of a client's; what is wrong with it."""
        try:
            said = json.loads(message)
            operation, topic = said["op"], said["topic"]
        except (ValueError, KeyError, TypeError):
            return "not a rosbridge message"
        if operation not in USED:
            return f"Unknown operation: {operation}"
        if operation == "publish":
            return self._published(topic, said.get("msg"))
        self.operations.append(f"{operation} {topic}")
        if operation == "subscribe" and topic == self._settings.state_topic:
            self._subscribed.add(connection)
        return ""

    def _published(self, topic: str, trajectory: Any) -> str:
        if f"advertise {topic}" not in self.operations:
            return f"topic {topic} was not advertised"
        if self.failing.deaf or topic != self._settings.trajectory_topic:
            return ""
        now_s = time.monotonic()
        try:
            points = trajectory["points"]
            times = [at["time_from_start"]["sec"] + at["time_from_start"]["nanosec"] * 1e-9 for at in points]
            names, angles = tuple(trajectory["joint_names"]), [at["positions"] for at in points]
            refusal = self.robot.follow(names, times, angles, [at["velocities"] for at in points], now_s)
        except (KeyError, TypeError, ValueError):
            return "the message does not have the form of its type"
        # A real controller only logs what it refuses; nobody who publishes hears of it.
        self.refusals += [refusal] if refusal else []
        self.trajectories += not refusal
        return ""

    async def _tell(self) -> None:
        due_s = time.monotonic()
        while True:
            now_s = time.monotonic()
            self.robot.step(now_s)
            if not self.failing.frozen:
                self._newest = self._state(now_s)
            self._under_way.append((now_s + self.failing.lag_s, self._newest))
            self._send_due(now_s)
            due_s = max(due_s + 1 / RATE_HZ, now_s - 1 / RATE_HZ)
            await asyncio.sleep(max(due_s - time.monotonic(), 0.0))

    def _send_due(self, now_s: float) -> None:
        due = [message for at_s, message in self._under_way if at_s <= now_s]
        self._under_way = [(at_s, message) for at_s, message in self._under_way if at_s > now_s]
        for message in () if self.failing.silent else due:
            self._broadcast(message)

    def _broadcast(self, message: str) -> None:
        """To all who subscribed; one that does not read loses messages and holds up nobody."""
        broadcast([c for c in self._subscribed if not c.transport.get_write_buffer_size()], message)

    def _state(self, now_s: float) -> str:
        stamp_s = now_s + CLOCK_AHEAD_S
        robot, lie = self.robot, self.failing.lie_rad
        state = {
            "header": {"stamp": {"sec": int(stamp_s), "nanosec": int(stamp_s % 1 * 1e9)}, "frame_id": ""},
            "name": robot.names,
            "position": [a + lie.get(n, 0.0) for a, n in zip(robot.angle_rad.tolist(), robot.names, strict=True)],
            "velocity": robot.velocity_rad_s.tolist(),
            "effort": [None] * len(robot.names),  # as rosbridge writes NaN
        }
        return json.dumps({"op": "publish", "topic": self._settings.state_topic, "msg": state})

    def _abort(self) -> None:
        for connection in self._connections:
            connection.transport.abort()


def _complaint(words: str) -> dict[str, str]:
    return {"op": "status", "level": "error", "msg": words}


def open_peer(exoskeleton: Exoskeleton) -> RosbridgePeer:
    """The peer where the exoskeleton's url points, not yet listening.

    Raises:
        InputError: the url does not point to this machine.
    """
    url = urlsplit(exoskeleton.rosbridge.url)
    if url.hostname not in (LOOPBACK, "localhost"):
        raise InputError(
            f"rosbridge.url is '{exoskeleton.rosbridge.url}'", f"ws://{LOOPBACK}:PORT: an emulated robot stays inside"
        )
    return RosbridgePeer(exoskeleton, url.port or USUAL_PORT)
