"""Lets logged-in pages through to viser, the live view's and the replay's: plain requests and its one WebSocket."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress

import httpx
from fastapi import APIRouter, Depends, HTTPException, Response, WebSocket, WebSocketDisconnect
from fastapi.responses import RedirectResponse
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidHandshake
from websockets.typing import Subprotocol

from db.account import Account
from server.api.deps import ServiceDep, get_account, get_therapist
from server.api.errors import as_response
from server.api.guard import REPLAY3D, VIEW3D
from server.api.race import until_first_ends
from server.api.service import Service
from server.api.socket_gate import admit, watch_log_in

router = APIRouter(include_in_schema=False)

_PASSED_ON = ("content-type", "cache-control")

# viser's own panel and notices would cover much of a small view; the dashboard has switches of its own.
_QUIET = b"""<style>
.mantine-Notifications-root, .mantine-Paper-root:is([style*="position: absolute"], [style*="position: fixed"])
{ display: none !important; }
</style></head>"""


def _let_through(prefix: str, port_of: Callable[[Service], int], *, is_record: bool) -> None:
    """Routes below `prefix` to the viser that listens on a port of the loopback address; 0 = it is closed.

    A past session's, perhaps another patient's, is for those who treat; the live view is for all who are logged in.
    """
    gate = [Depends(get_therapist if is_record else get_account)]

    @router.get(prefix, dependencies=gate)
    async def without_slash() -> RedirectResponse:
        """Viser's page finds its socket relative to the address with the slash."""
        return RedirectResponse(f"{prefix}/")

    @router.get(prefix + "/{path:path}", dependencies=gate)
    async def page(path: str, service: ServiceDep) -> Response:
        return await _page(port_of(service), path)

    # viser's page opens its socket at the prefix itself, without a slash.
    @router.websocket(prefix)
    @router.websocket(prefix + "/{path:path}")
    async def socket(socket: WebSocket, path: str = "") -> None:
        """Viser's socket, both ways, while the log-in lasts."""
        admitted = await admit(socket)
        if admitted is None:
            return
        service, account = admitted
        if is_record and not account.role.may_treat:
            await _refuse(socket, account)
        else:
            await _join(socket, service, port_of(service))


_let_through(VIEW3D, lambda service: service.view3d.port, is_record=False)
_let_through(REPLAY3D, lambda service: service.replay.port, is_record=True)


async def _refuse(socket: WebSocket, account: Account) -> None:
    await socket.send_denial_response(
        as_response(403, f"{account.name} may not do this", "a therapist's account", "log in with one")
    )


async def _page(port: int, path: str) -> Response:
    """Viser's own page, without its panel."""
    async with httpx.AsyncClient(base_url=f"http://127.0.0.1:{port}", trust_env=False) as client:
        try:
            answer = await client.get(f"/{path}")
        except httpx.HTTPError as error:
            raise HTTPException(502, "the 3-D view does not answer") from error
    headers = {name: answer.headers[name] for name in _PASSED_ON if name in answer.headers}
    return Response(answer.content.replace(b"</head>", _QUIET, 1), answer.status_code, headers)


async def _join(page_end: WebSocket, service: Service, port: int) -> None:
    if not port:
        await page_end.accept()  # closed before that, a page would take it for a refused log-in
        await page_end.close(1001, "nothing is shown")
        return
    asked = [Subprotocol(name) for name in page_end.scope.get("subprotocols", [])]
    # Without limits of our own: pictures are large, and both ends are ours.
    opening = connect(
        f"ws://127.0.0.1:{port}/",
        subprotocols=asked or None,
        compression=None,
        max_size=None,
        proxy=None,
    )
    try:
        async with opening as viser_end:
            await page_end.accept(subprotocol=viser_end.subprotocol)
            with suppress(WebSocketDisconnect, ConnectionClosed):
                await until_first_ends(
                    _to_viser(page_end, viser_end), _to_page(viser_end, page_end), watch_log_in(page_end, service)
                )
    except (OSError, InvalidHandshake):
        await page_end.close(1011, "the 3-D view does not answer")


async def _to_viser(page_end: WebSocket, viser_end: ClientConnection) -> None:
    async for message in page_end.iter_bytes():
        await viser_end.send(message)


async def _to_page(viser_end: ClientConnection, page_end: WebSocket) -> None:
    async for message in viser_end:
        await (page_end.send_text(message) if isinstance(message, str) else page_end.send_bytes(message))
