"""Puts the service together: routes, gate, lifespan."""

from __future__ import annotations

from fastapi import APIRouter, FastAPI

from server import __version__
from server.api.errors import add_error_handlers
from server.api.routes import accounts, patients, sessions, station


def describe_app() -> FastAPI:
    """The application without anything behind it: enough to describe its interface."""
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
    for resource in (accounts, patients, sessions, station):
        api.include_router(resource.router)
    app.include_router(api)
    return app
