"""The live stream: each page gets the newest tick as soon as it has drawn the one before, at most 60 times a second."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Coroutine
from contextlib import suppress
from typing import Any

import msgspec
from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from server.api.live import Acknowledgement
from server.api.newest import Newest
from server.api.race import until_first_ends
from server.api.relay import Broadcast
from server.api.service import Service
from server.api.socket_gate import admit, watch_log_in

router = APIRouter()

LEAST_PAUSE_S = 1 / 60

_acks = msgspec.json.Decoder(Acknowledgement)


@router.websocket("/api/stream")
async def stream(socket: WebSocket) -> None:
    """Send live messages, one per acknowledgement, while the log-in lasts."""
    service = await admit(socket)
    if service is None:
        return
    await socket.accept()
    with service.relay.pages.reading() as box, suppress(WebSocketDisconnect):
        await until_first_ends(*_Page(socket, box, service).works(), watch_log_in(socket, service))


class _Page:
    """One page that looks."""

    def __init__(self, socket: WebSocket, box: Newest[Broadcast], service: Service) -> None:
        self._socket, self._box, self._service = socket, box, service
        self._answers: Newest[Acknowledgement] = Newest()
        self._last_received_s: float | None = None

    def works(self) -> tuple[Coroutine[Any, Any, None], Coroutine[Any, Any, None]]:
        return self._send(), self._listen()

    async def _send(self) -> None:
        while True:
            broadcast = await self._box.take()
            sent_s = time.monotonic()
            await self._socket.send_text(broadcast.text)
            await self._until_drawn(broadcast)
            await asyncio.sleep(LEAST_PAUSE_S - (time.monotonic() - sent_s))

    async def _until_drawn(self, broadcast: Broadcast) -> None:
        tick = broadcast.message.tick
        while (answer := await self._answers.take()).ack != tick.index:
            continue  # an acknowledgement of something else, or a page that makes them up
        if answer.drawn_on is not None and tick.t_newest_received_s != self._last_received_s:
            self._last_received_s = tick.t_newest_received_s
            self._service.latency.drawn(tick, answer.drawn_on, time.monotonic())

    async def _listen(self) -> None:
        try:
            async for text in self._socket.iter_text():
                self._answers.put(_acks.decode(text))
        except msgspec.MsgspecError:
            await self._socket.close(1003, 'expected {"ack": index}')
