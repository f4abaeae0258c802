"""Runs the service: port and data folder first, then everything else, and one line with the address last."""

from __future__ import annotations

import gc
import socket
import sys

import uvicorn

from db.errors import DatabaseError
from fusion.errors import MachineError
from server.api.app import create_app
from server.api.data_folder import data_folder, locked
from server.api.station_link import STATION
from server.config import Config

SWITCH_S = 0.0005
"""How long a thread (the database, the 3-D view) may keep the interpreter while the event loop has a stop to carry."""
CLOSE_WITHIN_S = 3
"""Open streams get so long to end."""

LOGGING = {
    "version": 1,
    "disable_existing_loggers": False,
    "formatters": {"plain": {"format": "%(asctime)s %(levelname)s %(name)s: %(message)s"}},
    "handlers": {"stderr": {"class": "logging.StreamHandler", "formatter": "plain", "stream": "ext://sys.stderr"}},
    "root": {"handlers": ["stderr"], "level": "WARNING"},
    # What keeps the service from starting is said in one sentence by the command, not in a traceback here.
    "loggers": {"uvicorn.error": {"level": "CRITICAL"}},
}


def run(config: Config, station: tuple[str, ...] = STATION) -> None:
    """Serve until somebody ends it.

    Args:
        config: of the service.
        station: what Python is told to run as the station.

    Raises:
        MachineError: the port is in use, the data folder is in use, the database cannot be opened, the station does
            not come up.
    """
    folder = data_folder(config)
    with locked(folder), _listening(config.host, config.port) as listener:
        app = create_app(config, folder, station=station)
        server = _Server(_uvicorn_config(app, config), listener)
        try:
            server.run(sockets=[listener])
        except KeyboardInterrupt:
            return
        except SystemExit:  # uvicorn's way of saying that the start failed; the lifespan kept why
            _raise_failure(getattr(app.state, "failure", None))
            raise


class _Server(uvicorn.Server):
    def __init__(self, config: uvicorn.Config, listener: socket.socket) -> None:
        super().__init__(config)
        self._listener = listener

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        if self.started:
            settle_memory()
            sys.stdout.write(f"{address_of(self._listener)}\n")
            sys.stdout.flush()


def settle_memory() -> None:
    """Keep the garbage collector from walking through everything that was loaded: a quarter of a million objects stop
    the heartbeat for longer than the station waits (SR-9), again and again.
    """
    gc.collect()
    gc.freeze()
    sys.setswitchinterval(SWITCH_S)


def address_of(listener: socket.socket) -> str:
    """The address to open in a browser."""
    host, port = listener.getsockname()[:2]
    name = {"0.0.0.0": "127.0.0.1", "::": "[::1]"}.get(host, f"[{host}]" if ":" in host else host)  # noqa: S104 - named, not bound
    return f"http://{name}:{port}"


def _uvicorn_config(app: object, config: Config) -> uvicorn.Config:
    return uvicorn.Config(
        app,  # type: ignore[arg-type]  # an ASGI application
        host=config.host,
        log_level=None,  # as in LOGGING
        log_config=LOGGING,
        access_log=False,
        server_header=False,
        proxy_headers=False,  # a forged header must not make a stranger look like this machine
        # Deflating each frame costs more time than it saves on a local network.
        ws_per_message_deflate=False,
        ws_max_size=1 << 20,
        timeout_graceful_shutdown=CLOSE_WITHIN_S,
    )


def _listening(host: str, port: int) -> socket.socket:
    try:
        family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
        listener = socket.socket(family, socket.SOCK_STREAM)
    except OSError as error:
        raise _no_port(host, port, str(error)) from None
    try:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind((host, port))
        listener.listen(128)
    except OSError as error:
        listener.close()
        raise _no_port(host, port, error.strerror or str(error)) from None
    return listener


def _no_port(host: str, port: int, why: str) -> MachineError:
    return MachineError(
        f"Port {port} on {host} cannot be opened: {why}",
        "a free port on an address of this machine",
        "end the program that uses it (perhaps another mirrorlimb), or choose another with --port",
    )


def _raise_failure(failure: Exception | None) -> None:
    if isinstance(failure, DatabaseError):
        raise MachineError(failure.what, failure.expected, failure.remedy) from failure
    if failure is not None:
        raise failure
