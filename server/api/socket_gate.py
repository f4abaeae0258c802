"""The log-in of a WebSocket: asked for before it opens, and looked at again while it lasts."""

from __future__ import annotations

import asyncio

from fastapi import WebSocket
from fastapi.concurrency import run_in_threadpool

from db.account import Account
from server.api.auth import COOKIE
from server.api.errors import as_response
from server.api.service import Service

CHECKED_EVERY_S = 5.0
LOGGED_OUT = 4401
"""Close code: the log-in has run out."""


async def admit(socket: WebSocket) -> tuple[Service, Account] | None:
    """The service behind the socket, and who asks; None, and a refusal sent, where nobody is logged in."""
    service: Service = socket.app.state.service
    token = socket.cookies.get(COOKIE)
    account = service.auth.recognised(token) or await run_in_threadpool(service.auth.account_or_none, token)
    if account is not None:
        return service, account
    await socket.send_denial_response(as_response(401, "nobody is logged in", "a log-in", "log in"))
    return None


async def watch_log_in(socket: WebSocket, service: Service) -> None:
    """Close the socket when its log-in ends.

    While a session is open, a page that follows it counts as use: nobody may be logged off in mid-movement.
    """
    token = socket.cookies.get(COOKIE)
    while True:
        await asyncio.sleep(CHECKED_EVERY_S)
        is_use = service.therapy.is_open
        if await run_in_threadpool(service.auth.account_or_none, token, is_use) is None:
            await socket.close(LOGGED_OUT, "logged out")
            return
