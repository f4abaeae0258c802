"""A child process that is watched: started again when it dies, ended for good when we end."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import sys
import time
from collections.abc import Callable
from pathlib import Path

log = logging.getLogger(__name__)

FIRST_PAUSE_S, LONGEST_PAUSE_S = 0.2, 10.0
"""Between a death and the next start; doubled with each death, so that a child that cannot live costs little."""
GOOD_RUN_S = 30.0
"""A child that lived so long was well: the next death is a first one again."""
LAST_WORDS = 2000
"""Bytes of its error output that are looked at after a death."""


class Child:
    """A Python process, watched.

    Args:
        name: what people call it.
        command: what Python is told to run, and its arguments.
        log_path: where its output goes.
        on_death: told its last words each time it dies by itself, before it is started again.
    """

    def __init__(self, name: str, command: tuple[str, ...], log_path: Path, on_death: Callable[[str], None]) -> None:
        self.name, self._command, self._log_path, self._on_death = name, command, log_path, on_death
        self._process: asyncio.subprocess.Process | None = None
        self._watch: asyncio.Task[None] | None = None
        self._words_begin = 0
        self.restarts = 0
        """How often it died by itself."""

    @property
    def pid(self) -> int | None:
        """Its process number while it runs."""
        process = self._process
        return process.pid if process is not None and process.returncode is None else None

    async def start(self) -> None:
        """Start it and watch it."""
        await self._spawn()
        self._watch = asyncio.create_task(self._keep_alive(), name=f"watch {self.name}")

    async def close(self, grace_s: float = 3.0) -> None:
        """End it: politely, then by force."""
        if self._watch is not None:
            self._watch.cancel()
            await asyncio.gather(self._watch, return_exceptions=True)
        process = self._process
        if process is None or process.returncode is not None:
            return
        process.terminate()
        try:
            await asyncio.wait_for(process.wait(), grace_s)
        except TimeoutError:
            log.warning("%s did not end within %.0f s and was killed", self.name, grace_s)
            with contextlib.suppress(ProcessLookupError):
                process.kill()
            await process.wait()

    async def _spawn(self) -> None:
        self._log_path.parent.mkdir(parents=True, exist_ok=True)
        with self._log_path.open("ab") as output:
            self._words_begin = output.tell()
            # A session of its own: Ctrl-C at the terminal reaches us alone, and we end it in order.
            self._process = await asyncio.create_subprocess_exec(
                sys.executable,
                *self._command,
                stdin=asyncio.subprocess.DEVNULL,
                stdout=output,
                stderr=output,
                start_new_session=True,
            )

    async def _keep_alive(self) -> None:
        pause_s = FIRST_PAUSE_S
        while self._process is not None:
            started_s = time.monotonic()
            code = await self._process.wait()
            self.restarts += 1
            words = self._last_words() or f"it ended with code {code}"
            self._on_death(words)
            pause_s = FIRST_PAUSE_S if time.monotonic() - started_s > GOOD_RUN_S else pause_s
            await asyncio.sleep(pause_s)
            pause_s = min(2 * pause_s, LONGEST_PAUSE_S)
            await self._spawn()

    def _last_words(self) -> str:
        """The last line that it wrote in this run."""
        with self._log_path.open("rb") as words:
            words.seek(0, 2)
            words.seek(max(self._words_begin, words.tell() - LAST_WORDS))
            lines = words.read().decode(errors="replace").strip().splitlines()
        return lines[-1].strip() if lines else ""
