"""`mirrorlimb serve`: the station and the service in front of it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import msgspec
import typer

from server.config import Config, Port, read_config


def serve(
    host: Annotated[str | None, typer.Option(help="Address to serve on. Default: 127.0.0.1.")] = None,
    port: Annotated[int | None, typer.Option(min=0, max=65535, help="Port to serve on. Default: 8000.")] = None,
    data: Annotated[Path | None, typer.Option(help="Folder for database, recordings and logs.")] = None,
    demo: Annotated[
        bool, typer.Option("--demo", help="A virtual patient, virtual sensors and a simulated exoskeleton.")
    ] = False,
    config: Annotated[Path | None, typer.Option(help="Configuration file (TOML), see docs/station.md.")] = None,
) -> None:
    """Start the station and its web pages; the one line printed last is the address to open."""
    # The web framework is loaded here so that the other commands start at once.
    from server.api.serve import run

    run(_with_options(read_config(config) if config else Config(), host, port, data, demo))


def _with_options(config: Config, host: str | None, port: Port | None, data: Path | None, demo: bool) -> Config:
    """Options on the command line win over the file's."""
    given = {"host": host, "port": port, "data": str(data) if data else None, "demo": demo or None}
    return msgspec.structs.replace(config, **{key: value for key, value in given.items() if value is not None})
