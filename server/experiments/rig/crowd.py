"""`python -m server.experiments.rig.crowd`: everybody else who uses the service, as hard as they can."""

from __future__ import annotations

import argparse
import asyncio
import sqlite3
import sys
import threading
from collections.abc import Sequence
from contextlib import closing, suppress
from pathlib import Path
from typing import Final

import httpx
import msgspec
import viser
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed, InvalidHandshake
from websockets.typing import Subprotocol

from server.experiments.rig.live_service import ShortMessage, acknowledged

ROWS_AT_ONCE: Final = 500
BUSY_S: Final = 20.0
_message_from = msgspec.json.Decoder(ShortMessage).decode
# A page's first words to viser, without which it draws nothing for it.
_CAMERA: Final = msgspec.msgpack.encode(
    {
        "type": "ViewerCameraMessage",
        "wxyz": (1.0, 0.0, 0.0, 0.0),
        "position": (0.0, 0.5, -2.0),
        "fov": 0.7,
        "near": 0.01,
        "far": 100.0,
        "image_height": 600,
        "image_width": 800,
        "look_at": (0.0, 0.0, 1.0),
        "up_direction": (0.0, 1.0, 0.0),
    }
)


class Crowd:
    """Pages that look, a 3-D view, and people who write into the database.

    Args:
        url: of the service.
        cookie: of somebody who is logged in.
    """

    def __init__(self, url: str, cookie: str) -> None:
        self._url, self._sockets = url, url.replace("http", "ws")
        self._headers = {"Cookie": cookie}
        self.looking = 0
        """Pages that have drawn something."""

    async def look(self, page: int) -> None:
        """A page of the live stream, which draws as fast as it is sent to, and is opened again when it is lost."""
        address, first = f"{self._sockets}/api/stream?client=crowd-{page}", True
        while True:
            opening = connect(
                address, additional_headers=self._headers, ping_interval=None, open_timeout=None, proxy=None
            )
            with suppress(ConnectionClosed, OSError, InvalidHandshake):
                async with opening as socket:
                    async for text in socket:
                        self.looking, first = self.looking + first, False
                        await socket.send(acknowledged(_message_from(text).tick))

    async def look_in_3d(self) -> None:
        """A page with the 3-D view open."""
        viser_speech = [Subprotocol(f"viser-v{viser.__version__}")]
        address = f"{self._sockets}/view3d"
        opening = connect(
            address,
            additional_headers=self._headers,
            subprotocols=viser_speech,
            max_size=None,
            ping_interval=None,
            proxy=None,
        )
        async with opening as socket:
            await socket.send(_CAMERA)
            await socket.recv()
            self.looking += 1
            async for _ in socket:
                continue

    async def write(self) -> None:
        """Somebody who enrols patients and reads their histories without a pause."""
        async with httpx.AsyncClient(
            base_url=self._url, headers=self._headers, timeout=BUSY_S, trust_env=False
        ) as client:
            number = 0
            while True:
                number += 1
                with suppress(httpx.HTTPError):  # the database may be too busy for too long
                    await client.post("/api/patients", json={"name": f"C-{number}", "healthy_side": "left"})
                    await client.get("/api/patients/1/sessions")


def write_past_the_service(path: Path) -> None:
    """Another program that keeps the database file busy with transactions of its own."""
    with closing(sqlite3.connect(path, timeout=BUSY_S, isolation_level=None)) as database:
        database.execute("CREATE TABLE IF NOT EXISTS crowd (number INTEGER, text TEXT)")
        while True:
            database.execute("BEGIN IMMEDIATE")
            database.executemany("INSERT INTO crowd VALUES (?, ?)", [(k, "x" * 200) for k in range(ROWS_AT_ONCE)])
            database.execute("DELETE FROM crowd")
            database.execute("COMMIT")


async def gather(crowd: Crowd, pages: int, writers: int) -> None:
    """Everybody at once, until somebody ends the process."""
    works = [*(crowd.look(page) for page in range(pages)), *(crowd.write() for _ in range(writers))]
    await asyncio.gather(crowd.look_in_3d(), _say_when(crowd, pages + 1), *works)


async def _say_when(crowd: Crowd, all_of_them: int) -> None:
    while crowd.looking < all_of_them:
        await asyncio.sleep(0.05)
    sys.stdout.write("everybody looks\n")
    sys.stdout.flush()


def main(arguments: Sequence[str] | None = None) -> int:
    """Use the service until somebody ends this process."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--url", required=True, help="of the service")
    parser.add_argument("--cookie", required=True, help="of somebody who is logged in")
    parser.add_argument("--pages", type=int, default=100, help="live pages")
    parser.add_argument("--writers", type=int, default=2, help="people who write")
    parser.add_argument("--database", type=Path, required=True, help="its database file")
    options = parser.parse_args(arguments)
    threading.Thread(target=write_past_the_service, args=(options.database,), daemon=True).start()
    asyncio.run(gather(Crowd(options.url, options.cookie), options.pages, options.writers))
    return 0


if __name__ == "__main__":
    sys.exit(main())
