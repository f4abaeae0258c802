"""An emulated robot behind rosbridge in a process of its own, as `mirrorlimb emulate` runs it."""

from __future__ import annotations

import socket
import subprocess
import sys
import tempfile
from pathlib import Path
from types import TracebackType
from typing import Final, Self

import msgspec

from server.exoskeleton import Exoskeleton, RosbridgeSettings

_COMMAND: Final = "from server.cli.main import main; main()"


class EmulatedProcess:
    """The process, ended with the block.

    Args:
        exoskeleton: its joints.
    """

    def __init__(self, exoskeleton: Exoskeleton) -> None:
        url = f"ws://127.0.0.1:{_free_port()}"
        self.device = msgspec.structs.replace(exoskeleton, drive="rosbridge", rosbridge=RosbridgeSettings(url=url))
        """The exoskeleton as its file has it."""

    def __enter__(self) -> Self:
        self._folder = tempfile.TemporaryDirectory(prefix="mirrorlimb-")
        file = Path(self._folder.name) / "robot.json"
        file.write_bytes(msgspec.json.encode(self.device))
        self._process = subprocess.Popen(  # noqa: S603 - our own command
            [sys.executable, "-c", _COMMAND, "emulate", "rosbridge", "--exoskeleton", str(file)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            bufsize=1,
        )
        self._heard()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._process.terminate()
        self._process.communicate()
        self._folder.cleanup()

    def tell(self, line: str) -> None:
        """Make it fail as a typed line says; returns when it does."""
        if self._process.stdin is not None:
            self._process.stdin.write(f"{line}\n")
        self._heard()

    def _heard(self) -> None:
        if self._process.stdout is not None:
            self._process.stdout.readline()


def _free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as server:
        port: int = server.getsockname()[1]
        return port
