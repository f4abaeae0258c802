"""Every error as the REST interface gives it: {"detail": {"what", "expected", "remedy"}}."""

from __future__ import annotations

import logging
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from pydantic import BaseModel, ConfigDict
from starlette.exceptions import HTTPException

from db.errors import DatabaseError
from fusion.errors import InputError, MachineError, MirrorlimbError, RefusedError

log = logging.getLogger(__name__)


class ErrorDetail(BaseModel):
    """What is wrong, what would have been right, and what to do."""

    what: str
    expected: str
    remedy: str


class ErrorResponse(BaseModel):
    """The one form of every error."""

    detail: ErrorDetail

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {
                    "detail": {
                        "what": "there is no patient 7",
                        "expected": "the number of an enrolled patient",
                        "remedy": "choose one from the list of patients",
                    }
                }
            ]
        }
    )


class ApiError(MirrorlimbError):
    """An error that belongs to the web side: not logged in, not found, asked too often."""

    def __init__(self, status: int, what: str, expected: str = "", remedy: str = "") -> None:
        super().__init__(what, expected, remedy)
        self.status = status


def not_found(thing: str, number: int) -> ApiError:
    """There is no such thing."""
    return ApiError(404, f"there is no {thing} {number}", f"the number of an existing {thing}", "look at the list")


def answers(*statuses: int) -> dict[int | str, dict[str, Any]]:
    """What a route may answer besides success, for its OpenAPI entry."""
    return {status: {"model": ErrorResponse, "description": _MEANINGS[status]} for status in statuses}


_MEANINGS = {
    401: "Nobody is logged in",
    403: "Not allowed from here, or not for this account",
    404: "There is no such thing",
    409: "Refused in the present state; the reason is in the detail",
    422: "The form is filled in wrongly",
    429: "Asked too often",
    503: "Something this machine must provide is missing",
}

_STATUS_OF: tuple[tuple[type[MirrorlimbError], int], ...] = (
    (RefusedError, 409),
    (InputError, 422),
    (MachineError, 503),
)


def as_response(status: int, what: str, expected: str = "", remedy: str = "") -> JSONResponse:
    """An error's response."""
    return JSONResponse({"detail": {"what": what, "expected": expected, "remedy": remedy}}, status)


def add_error_handlers(app: FastAPI) -> None:
    """Give every error of this program, of the framework and of nobody the same form."""
    app.exception_handler(MirrorlimbError)(_ours)
    app.exception_handler(DatabaseError)(_database)
    app.exception_handler(RequestValidationError)(_invalid)
    app.exception_handler(HTTPException)(_framework)
    app.exception_handler(Exception)(_unforeseen)


async def _ours(_: Request, error: MirrorlimbError) -> JSONResponse:
    status = error.status if isinstance(error, ApiError) else _status_of(error)
    return as_response(status, error.what, error.expected, error.remedy)


def _status_of(error: MirrorlimbError) -> int:
    return next((status for kind, status in _STATUS_OF if isinstance(error, kind)), 500)


async def _database(_: Request, error: DatabaseError) -> JSONResponse:
    return as_response(503, error.what, error.expected, error.remedy)


async def _invalid(_: Request, error: RequestValidationError) -> JSONResponse:
    first, *more = error.errors()
    where = ".".join(str(part) for part in first["loc"] if part != "body") or "the form"
    what = f"{where}: {first['msg'][:1].lower()}{first['msg'][1:]}"
    others = f" ({len(more)} more)" if more else ""
    return as_response(
        422, what + others, "a form as /api/openapi.json describes it", f"correct {where} and send it again"
    )


async def _framework(request: Request, error: HTTPException) -> JSONResponse:
    what = f"{request.method} {request.url.path}: {str(error.detail).lower()}"
    return as_response(error.status_code, what, "a route listed in /api/openapi.json", "look at the address")


async def _unforeseen(request: Request, error: Exception) -> JSONResponse:
    log.error("%s %s failed", request.method, request.url.path, exc_info=error)
    return as_response(
        500,
        "the program made a mistake of its own",
        "an answer",
        "try again; if it comes back, report it with the log",
    )
