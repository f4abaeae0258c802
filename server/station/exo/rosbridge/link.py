"""The WebSocket to rosbridge in a thread of its own: the newest command leaves, what comes is handed over at once.

A link that breaks says so and is tried again; what was to be sent before it broke is not sent after.
"""

from __future__ import annotations

import asyncio
import logging
import os
import socket
import threading
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import suppress
from types import TracebackType
from typing import Self

from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import WebSocketException

from fusion.errors import MachineError
from server.station import pacemaker
from server.station.exo.rosbridge.wire import LONGEST_MESSAGE_BYTES

log = logging.getLogger(__name__)

OPEN_WITHIN_S = 3.0
AGAIN_AFTER_S = 0.5
UNANSWERED_S = 1.0
"""A peer that answers no ping for so long is gone."""
CLOSE_WITHIN_S = 0.3
UNSENT_BYTES = 4096
"""What may wait in the socket: a peer that stops reading and goes on must not act on a second of old commands."""


class Link:
    """One rosbridge server.

    Args:
        url: of its WebSocket.
        greeting: sent first, each time the link is made.
        farewell: sent last.
        on_message: given every message, in the link's thread.
        on_broken: told when a link has broken, in the link's thread.
    """

    def __init__(
        self,
        url: str,
        greeting: tuple[bytes, ...],
        farewell: bytes,
        on_message: Callable[[str | bytes], None],
        on_broken: Callable[[], None],
    ) -> None:
        self._url, self._greeting, self._farewell = url, greeting, farewell
        self._on_message, self._on_broken = on_message, on_broken
        self._opened: Future[None] = Future()
        self._outgoing: bytes | None = None
        self._loop: asyncio.AbstractEventLoop | None = None
        self._task: asyncio.Task[None] | None = None
        self._something = asyncio.Event()
        self._thread = threading.Thread(target=self._run, name="rosbridge", daemon=True)
        self.trouble = ""
        """Why there is no link now, in plain words."""

    def __enter__(self) -> Self:
        """Make the link.

        Raises:
            MachineError: nobody answers there.
        """
        self._thread.start()
        self._opened.result()  # `open_timeout` bounds it
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._task is not None:
            self._tell(self._task.cancel)
        self._thread.join(4 * CLOSE_WITHIN_S)

    def give(self, message: bytes) -> None:
        """Send this next, in place of whatever still waits. Never blocks."""
        self._outgoing = message
        self._tell(self._something.set)

    def _tell(self, act: Callable[[], object]) -> None:
        with suppress(RuntimeError):  # the thread has ended
            if self._loop is not None:
                self._loop.call_soon_threadsafe(act)

    # ---------------------------------------------------------------- in the thread

    def _run(self) -> None:
        pacemaker.ask_for_priority()  # a thread of ordinary priority would send late under load
        try:
            asyncio.run(self._keep())
        except asyncio.CancelledError:
            return
        except Exception:
            self.trouble = "The link to the robot has failed by a fault of its own; see the log."
            log.exception("the link's thread has ended")

    async def _keep(self) -> None:
        self._loop, self._task = asyncio.get_running_loop(), asyncio.current_task()
        while await self._goes_on():
            await asyncio.sleep(AGAIN_AFTER_S)

    async def _goes_on(self) -> bool:
        """Hold the link until it breaks; one that was never made is not tried again."""
        try:
            await self._once()
        except (OSError, WebSocketException, TimeoutError) as error:
            self.trouble = f"The connection to '{self._url}' was lost ({_why(error)})."
            if not self._opened.done():
                self._opened.set_exception(_nobody(self._url, error))
                return False
        self._on_broken()
        return True

    async def _once(self) -> None:
        async with connect(
            self._url,
            compression=None,
            proxy=None,
            open_timeout=OPEN_WITHIN_S,
            ping_interval=UNANSWERED_S,
            ping_timeout=UNANSWERED_S,
            close_timeout=CLOSE_WITHIN_S,
            max_size=LONGEST_MESSAGE_BYTES,
            write_limit=UNSENT_BYTES,
        ) as connection:
            _keep_little(connection)
            for message in self._greeting:
                await connection.send(message, text=True)
            self._outgoing, self.trouble = None, ""
            if not self._opened.done():
                self._opened.set_result(None)
            await self._converse(connection)

    async def _converse(self, connection: ClientConnection) -> None:
        sending = asyncio.create_task(self._send(connection))
        try:
            while True:
                self._on_message(await connection.recv())
        finally:
            sending.cancel()
            with suppress(WebSocketException, TimeoutError):
                async with asyncio.timeout(CLOSE_WITHIN_S):
                    await connection.send(self._farewell, text=True)

    async def _send(self, connection: ClientConnection) -> None:
        with suppress(WebSocketException):  # the receiver sees it too, and says it
            while True:
                await self._something.wait()
                self._something.clear()
                message, self._outgoing = self._outgoing, None
                if message is not None:
                    await connection.send(message, text=True)


def _keep_little(connection: ClientConnection) -> None:
    held: socket.socket = connection.transport.get_extra_info("socket")
    held.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, UNSENT_BYTES)


def _why(error: BaseException) -> str:
    if isinstance(error, TimeoutError):
        return "no answer in time"
    return os.strerror(error.errno) if isinstance(error, OSError) and error.errno else f"{error}".rstrip(".")


def _nobody(url: str, error: BaseException) -> MachineError:
    return MachineError(
        f"No rosbridge server answers at '{url}' ({_why(error)})",
        "a rosbridge WebSocket as named by 'rosbridge.url' in the exoskeleton file",
        "ros2 launch rosbridge_server rosbridge_websocket_launch.xml",
    )
