"""The outermost layer: refuses requests that other sites make in somebody's name, and tells browsers what is allowed.

Host is checked because a name that an attacker owns may be pointed at this machine (DNS rebinding); Origin, because a
browser sends our cookie's neighbours along with whatever page asks.
"""

from __future__ import annotations

import socket
from dataclasses import dataclass
from ipaddress import ip_address
from urllib.parse import urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from starlette.websockets import WebSocket

from server.api.errors import as_response

VIEW3D, REPLAY3D = "/view3d", "/replay3d"
"""Below these addresses viser's own pages come through: the live view, and a past session's."""
_SAFE_METHODS = frozenset({"GET", "HEAD", "OPTIONS"})

_OWN_PAGES = (
    "default-src 'self'; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; worker-src 'self' blob:; "
    "connect-src 'self'; object-src 'none'; base-uri 'none'; form-action 'self'; frame-src 'self'; "
    "frame-ancestors 'self'"
)
# viser's page is one file that unpacks itself: inline scripts, WebAssembly, workers and pictures from memory.
_VIEW3D_PAGE = (
    "default-src 'self' 'unsafe-inline' 'unsafe-eval' data: blob:; connect-src 'self' data: blob:; "
    "object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'self'"
)


@dataclass(frozen=True, slots=True)
class Guard:
    """ASGI middleware around the whole application.

    Args:
        app: what it guards.
        host: the address that the service listens on; its name is accepted beside loopback names and plain addresses.
    """

    app: ASGIApp
    host: str

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Refuse, or pass on and add the headers."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        wrong = _what_is_wrong(scope, self.host)
        if wrong is None:
            await self.app(scope, receive, _with_headers(scope, send))
        else:
            await _refuse(wrong, scope, receive, send)


async def _refuse(wrong: str, scope: Scope, receive: Receive, send: Send) -> None:
    response = as_response(403, wrong, "a request from this service's own pages", "open the address that it printed")
    if scope["type"] == "websocket":
        await WebSocket(scope, receive, send).send_denial_response(response)
    else:
        await response(scope, receive, send)


def _what_is_wrong(scope: Scope, own_host: str) -> str | None:
    headers = Headers(scope=scope)
    host, origin = headers.get("host", ""), headers.get("origin")
    if not is_own_host(host, own_host):
        return f"this service is not called '{host}'"
    if origin is not None and _origin_matters(scope) and not _is_same_origin(origin, host):
        return f"a page of '{origin}' may not do this"
    if headers.get("sec-fetch-site") in ("cross-site", "same-site") and _origin_matters(scope):
        return "a page of another site may not do this"
    return None


def _origin_matters(scope: Scope) -> bool:
    return scope["type"] == "websocket" or scope["method"] not in _SAFE_METHODS


def _is_same_origin(origin: str, host: str) -> bool:
    parts = urlsplit(origin)
    return parts.scheme in ("http", "https") and parts.netloc.lower() == host.lower()


def is_own_host(host: str, own_host: str) -> bool:
    """Whether a Host header names this machine: a plain address, a loopback name, or our own name."""
    try:
        name = (urlsplit(f"//{host}").hostname or "").lower()
    except ValueError:
        return False
    if name in {"localhost", own_host.lower(), socket.gethostname().lower()} and name:
        return True
    try:
        ip_address(name)
    except ValueError:
        return False
    return True


def _with_headers(scope: Scope, send: Send) -> Send:
    async def send_with_headers(message: Message) -> None:
        if message["type"] in ("http.response.start", "websocket.http.response.start"):
            _add_headers(MutableHeaders(scope=message), scope["path"])
        await send(message)

    return send_with_headers


def _add_headers(headers: MutableHeaders, path: str) -> None:
    is_visers = any(path == view or path.startswith(f"{view}/") for view in (VIEW3D, REPLAY3D))
    headers["Content-Security-Policy"] = _VIEW3D_PAGE if is_visers else _OWN_PAGES
    headers["X-Content-Type-Options"] = "nosniff"
    headers["X-Frame-Options"] = "SAMEORIGIN"
    headers["Referrer-Policy"] = "same-origin"
    headers["Cross-Origin-Opener-Policy"] = "same-origin"
    headers["Cross-Origin-Resource-Policy"] = "same-origin"
    headers["Permissions-Policy"] = "camera=(), microphone=(), geolocation=()"
    if path.startswith("/api"):
        headers["Cache-Control"] = "no-store"
