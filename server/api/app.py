"""Puts the service together: routes, guard, pages, lifespan."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

from fastapi import APIRouter, FastAPI

from server import __version__
from server.api import proxy3d, stream
from server.api.auth import AuthSettings
from server.api.errors import add_error_handlers
from server.api.guard import Guard
from server.api.pages import BUILT, add_pages
from server.api.routes import accounts, clinical_scores, games, patients, plans, progress, replay, sessions, station
from server.api.service import running_service
from server.api.station_link import STATION
from server.config import Config


def create_app(
    config: Config,
    data: Path,
    auth_settings: AuthSettings | None = None,
    built: Path = BUILT,
    station: tuple[str, ...] = STATION,
) -> FastAPI:
    """The whole application; its lifespan opens database, station and 3-D view, and closes them.

    Args:
        config: the service's configuration.
        data: the data folder, locked by the caller.
        auth_settings: how long log-ins last.
        built: the built browser side.
        station: what Python is told to run as the station.
    """

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        try:
            async with running_service(config, data, auth_settings or AuthSettings(), station) as service:
                app.state.service = service
                yield
        except Exception as error:
            app.state.failure = error  # uvicorn only says that it failed; `serve` says why
            raise

    app = describe_app()
    app.router.lifespan_context = lifespan
    app.include_router(stream.router)
    app.include_router(proxy3d.router)
    add_pages(app, built)
    app.add_middleware(Guard, host=config.host)
    return app


def describe_app() -> FastAPI:
    """The REST routes without anything behind them: enough to describe the interface."""
    app = FastAPI(
        title="mirrorlimb",
        version=__version__,
        description="Mirror therapy: patients, sessions, control of the arm, and what was measured.",
        docs_url=None,  # its page is fetched from elsewhere; a station may have no way out
        redoc_url=None,
        openapi_url="/api/openapi.json",
    )
    add_error_handlers(app)
    api = APIRouter(prefix="/api")
    for resource in (accounts, patients, plans, clinical_scores, progress, sessions, games, station, replay):
        api.include_router(resource.router)
    app.include_router(api)
    return app
