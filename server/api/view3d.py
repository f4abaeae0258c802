"""The 3-D view: viser on this machine only, behind our own proxy and log-in; it works only while somebody looks."""

from __future__ import annotations

import asyncio
import logging
from contextlib import redirect_stdout
from io import StringIO

import viser

from server.api.newest import FanOut
from server.api.view3d_picture import Picture, picture_of
from server.api.view3d_scene import Scene, Shown
from server.messages import LiveTick

log = logging.getLogger(__name__)

PERIOD_S = 1 / 30


class View3D:
    """viser's server with our scene, fed from the ticks.

    Args:
        ticks: where the ticks come from.
    """

    def __init__(self, ticks: FanOut[LiveTick]) -> None:
        self._ticks = ticks
        self._task: asyncio.Task[None] | None = None
        self._server: viser.ViserServer | None = None
        self.port = 0
        """Port on the loopback address."""
        self.shown = Shown(sensors=True, bounds=False)
        """What a person has switched on."""

    def start(self) -> None:
        """Open the server and begin to draw."""
        self._server = open_viser()
        self.port = self._server.get_port()
        self._task = asyncio.create_task(self._draw(self._server, Scene(self._server)))

    async def close(self) -> None:
        """Stop drawing and close the server."""
        if self._task is not None:
            self._task.cancel()
            await asyncio.gather(self._task, return_exceptions=True)
        if self._server is not None:
            await asyncio.to_thread(close_viser, self._server)

    async def _draw(self, server: viser.ViserServer, scene: Scene) -> None:
        with self._ticks.reading() as box:
            while True:
                tick = await box.take()
                if server.get_clients():
                    show(server, scene, picture_of(tick), self.shown)
                await asyncio.sleep(PERIOD_S)


def open_viser() -> viser.ViserServer:
    """A server on a free port of the loopback address, looking at the person. It may be called in any thread."""
    # viser listens on every address unless told otherwise, and asks nobody for a log-in.
    with redirect_stdout(StringIO()):  # it prints its own address, which nobody may use
        server = _OnlyHere(host="127.0.0.1", port=0, label="mirrorlimb", verbose=False)
    _place_camera(server)
    return server


def close_viser(server: viser.ViserServer) -> None:
    """End it; waits for its thread."""
    with redirect_stdout(StringIO()):
        server.stop()


class _OnlyHere(viser.ViserServer):
    """viser opens a public tunnel to itself, past our log-in, for any page that asks; ours does not."""

    def request_share_url(self, verbose: bool = True) -> str | None:
        return None


def show(server: viser.ViserServer, scene: Scene, picture: Picture, shown: Shown) -> None:
    """Draw, so that no page sees half of it; what cannot be drawn is logged, and the next picture tried."""
    try:
        with server.atomic():
            scene.show(picture, shown)
    except Exception:
        log.exception("a picture could not be drawn")


def _place_camera(server: viser.ViserServer) -> None:
    """Before the person, a little to the side and above, as somebody beside the reference sensor sees them."""
    camera = server.initial_camera
    camera.position = (-1.3, 0.65, -0.4)
    camera.look_at = (-0.15, -0.2, 1.9)
    camera.fov = 0.7
    camera.up = (0.0, 1.0, 0.0)
