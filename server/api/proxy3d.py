"""Lets logged-in pages through to viser: plain requests and its one WebSocket."""

from __future__ import annotations

from contextlib import suppress

import httpx
from fastapi import APIRouter, HTTPException, Response, WebSocket, WebSocketDisconnect
from fastapi.responses import RedirectResponse
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidHandshake
from websockets.typing import Subprotocol

from server.api.deps import AccountDep, ServiceDep
from server.api.guard import VIEW3D
from server.api.race import until_first_ends
from server.api.socket_gate import admit, watch_log_in

router = APIRouter(include_in_schema=False)

_PASSED_ON = ("content-type", "cache-control")

# viser's own panel and notices would cover much of a small view; the dashboard has switches of its own.
_QUIET = b"""<style>
.mantine-Notifications-root, .mantine-Paper-root:is([style*="position: absolute"], [style*="position: fixed"])
{ display: none !important; }
</style></head>"""


@router.get(VIEW3D)
async def without_slash(_: AccountDep) -> RedirectResponse:
    """Viser's page finds its socket relative to the address with the slash."""
    return RedirectResponse(f"{VIEW3D}/")


@router.get(VIEW3D + "/{path:path}")
async def page(path: str, _: AccountDep, service: ServiceDep) -> Response:
    """Viser's own page, without its panel."""
    async with httpx.AsyncClient(base_url=f"http://127.0.0.1:{service.view3d.port}", trust_env=False) as client:
        try:
            answer = await client.get(f"/{path}")
        except httpx.HTTPError as error:
            raise HTTPException(502, "the 3-D view does not answer") from error
    headers = {name: answer.headers[name] for name in _PASSED_ON if name in answer.headers}
    return Response(answer.content.replace(b"</head>", _QUIET, 1), answer.status_code, headers)


# viser's page opens its socket at the prefix itself, without a slash.
@router.websocket(VIEW3D)
@router.websocket(VIEW3D + "/{path:path}")
async def socket(socket: WebSocket, path: str = "") -> None:
    """Viser's socket, both ways, while the log-in lasts."""
    admitted = await admit(socket)
    if admitted is None:
        return
    service, _ = admitted
    asked = [Subprotocol(name) for name in socket.scope.get("subprotocols", [])]
    # Without limits of our own: pictures are large, and both ends are ours.
    opening = connect(
        f"ws://127.0.0.1:{service.view3d.port}/",
        subprotocols=asked or None,
        compression=None,
        max_size=None,
        proxy=None,
    )
    try:
        async with opening as viser_end:
            await socket.accept(subprotocol=viser_end.subprotocol)
            with suppress(WebSocketDisconnect, ConnectionClosed):
                await until_first_ends(
                    _to_viser(socket, viser_end), _to_page(viser_end, socket), watch_log_in(socket, service)
                )
    except (OSError, InvalidHandshake):
        await socket.close(1011, "the 3-D view does not answer")


async def _to_viser(page_end: WebSocket, viser_end: ClientConnection) -> None:
    async for message in page_end.iter_bytes():
        await viser_end.send(message)


async def _to_page(viser_end: ClientConnection, page_end: WebSocket) -> None:
    async for message in viser_end:
        await (page_end.send_text(message) if isinstance(message, str) else page_end.send_bytes(message))
