"""The live stream: each page gets the newest tick as soon as it has drawn the one before, at most 60 times a second."""

from __future__ import annotations

import asyncio
import re
import time
from collections.abc import Coroutine
from contextlib import suppress
from typing import Any

import msgspec
from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from server.api.authority import PAGE_NAME, Client, Connection
from server.api.errors import as_response
from server.api.live import Acknowledgement
from server.api.newest import Newest
from server.api.race import until_first_ends
from server.api.relay import Broadcast
from server.api.service import Service
from server.api.socket_gate import admit, watch_log_in

router = APIRouter()

LEAST_PAUSE_S = 1 / 60
MESSAGES_PER_S = 1200
"""To all pages together: with more than twenty, each gets fewer, so that a stop need not wait for them (SR-7)."""
HIDDEN_PAUSE_S = 0.1
"""For a page that nobody sees, which answers at once without drawing: it is there, and needs no more."""
REPLACED = 4409
"""Close code: the same page has opened a newer stream."""

_acks = msgspec.json.Decoder(Acknowledgement)


@router.websocket("/api/stream")
async def stream(socket: WebSocket) -> None:
    """Send live messages, one per acknowledgement, while the log-in lasts."""
    admitted = await admit(socket)
    if admitted is None:
        return
    service, account = admitted
    client = Client(account.id or 0, account.name, socket.query_params.get("client", ""))
    if not re.fullmatch(PAGE_NAME, client.page):
        await socket.send_denial_response(as_response(422, "the page's name cannot be used", PAGE_NAME, "reload it"))
        return
    await socket.accept()
    with (
        service.relay.pages.reading() as box,
        service.presence.connected(client) as connection,
        suppress(WebSocketDisconnect),
    ):
        works = _Page(socket, box, connection, service).works()
        await until_first_ends(*works, _until_replaced(socket, connection), watch_log_in(socket, service))


async def _until_replaced(socket: WebSocket, connection: Connection) -> None:
    await connection.replaced.wait()
    await socket.close(REPLACED, "this page is open anew")


class _Page:
    """One page that looks."""

    def __init__(self, socket: WebSocket, box: Newest[Broadcast], connection: Connection, service: Service) -> None:
        self._socket, self._box, self._connection, self._service = socket, box, connection, service
        self._answers: Newest[Acknowledgement] = Newest()
        self._last_received_s: float | None = None

    def works(self) -> tuple[Coroutine[Any, Any, None], Coroutine[Any, Any, None]]:
        return self._send(), self._listen()

    async def _send(self) -> None:
        while True:
            broadcast = await self._box.take()
            sent_s = time.monotonic()
            await self._socket.send_text(broadcast.text)
            answer = await self._until_drawn(broadcast)
            pause_s = HIDDEN_PAUSE_S if answer.drawn_on is None else LEAST_PAUSE_S
            pause_s = max(pause_s, self._service.relay.pages.readers / MESSAGES_PER_S)
            await asyncio.sleep(pause_s - (time.monotonic() - sent_s))

    async def _until_drawn(self, broadcast: Broadcast) -> Acknowledgement:
        tick = broadcast.message.tick
        while (answer := await self._answers.take()).ack != tick.index:
            continue  # an acknowledgement of something else, or a page that makes them up
        if answer.drawn_on is not None and tick.t_newest_received_s != self._last_received_s:
            self._last_received_s = tick.t_newest_received_s
            self._service.latency.drawn(tick, answer.drawn_on, time.monotonic())
        return answer

    async def _listen(self) -> None:
        try:
            async for text in self._socket.iter_text():
                answer = _acks.decode(text)
                self._answers.put(answer)
                self._connection.heard(answer.drawn_on)
        except msgspec.MsgspecError:
            await self._socket.close(1003, 'expected {"ack": index}')
