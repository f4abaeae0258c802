"""The built browser side, where there is one; and plain words where there is not, or no such route."""

from __future__ import annotations

from pathlib import Path

from fastapi import FastAPI
from fastapi.responses import FileResponse, HTMLResponse, Response
from fastapi.staticfiles import StaticFiles
from starlette.exceptions import HTTPException
from starlette.types import Scope

_ALL_METHODS = ["GET", "POST", "PUT", "PATCH", "DELETE"]
BUILT = Path(__file__).parent / "static"

_NOT_BUILT = """<!doctype html><html lang="en"><meta charset="utf-8"><title>mirrorlimb</title>
<body style="font: 1.4rem/1.6 sans-serif; margin: 4rem; max-width: 40rem">
<h1>The pages have not been built</h1>
<p>The service is running, but its browser side is missing. In the folder of the program, type</p>
<pre><code>make setup</code></pre><p>and load this page again.</p></body></html>"""


def add_pages(app: FastAPI, built: Path = BUILT) -> None:
    """Serve what no route took: JSON 404 below /api, the built pages elsewhere. Add it after all routes."""
    for path in ("/api", "/api/{path:path}"):
        app.add_api_route(path, _no_such_route, methods=_ALL_METHODS, include_in_schema=False)
    if (built / "index.html").is_file():
        app.mount("/", _Pages(directory=built, html=True))
    else:
        app.add_api_route("/{path:path}", _not_built, methods=["GET"], include_in_schema=False)


async def _no_such_route() -> None:
    raise HTTPException(404, "no such route")


async def _not_built() -> HTMLResponse:
    return HTMLResponse(_NOT_BUILT, 503)


class _Pages(StaticFiles):
    """The pages; an address that is no file is the dashboard's own business, so it gets the dashboard."""

    async def get_response(self, path: str, scope: Scope) -> Response:
        try:
            response = await super().get_response(path, scope)
        except HTTPException as error:
            if error.status_code != 404 or "." in Path(path).name:
                raise
            response = FileResponse(Path(str(self.directory)) / "index.html")
        return _cached(response, path)


def _cached(response: Response, path: str) -> Response:
    # Names in assets/ carry a hash of their content; pages must be asked for each time.
    forever = path.startswith("assets/") and response.status_code == 200
    response.headers["Cache-Control"] = "public, max-age=31536000, immutable" if forever else "no-cache"
    return response
