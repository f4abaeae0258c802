"""Writes what happens in a session to the database, in order, without ever making the event loop wait."""

from __future__ import annotations

import asyncio
import logging
from typing import Any

from fastapi.concurrency import run_in_threadpool

from db.columns import now_utc
from db.database import Database
from db.errors import DatabaseError
from db.queries import sessions
from db.therapy_session import Event
from games.game import GameView
from server.messages import AnyEvent, StateChanged, Warned

log = logging.getLogger(__name__)

KEPT = 10_000
"""Events that wait for a database that does not answer; beyond that the newest are dropped and logged."""
SCORE = "score"
"""Kind of the events that keep the game's count; a crash loses nothing of it."""
CONTROL = "control"
"""Kind of the events that say what people wanted of the arm."""
RETRY_S = 0.5
TRIES = 10


class Journal:
    """The book of the session that is open."""

    def __init__(self, database: Database) -> None:
        self._database = database
        self._waiting: asyncio.Queue[Event] = asyncio.Queue(KEPT)
        self._writer: asyncio.Task[None] | None = None

    def start(self) -> None:
        """Begin to write."""
        self._writer = asyncio.create_task(self._write(), name="journal")

    async def close(self) -> None:
        """Write what still waits, if it can be written within a moment, and end."""
        try:
            await asyncio.wait_for(self.written(), 2.0)
        except TimeoutError:
            log.error("%d events were not stored", self._waiting.qsize())
        if self._writer is not None:
            self._writer.cancel()
            await asyncio.gather(self._writer, return_exceptions=True)

    def note(self, session_id: int, kind: str, text: str, **data: Any) -> None:
        """Something happened now. Never waits."""
        event = Event(session_id=session_id, t=now_utc(), kind=kind, text=text[:1000], data=data)
        try:
            self._waiting.put_nowait(event)
        except asyncio.QueueFull:
            log.error("an event was dropped: %s %s", kind, text)

    def note_event(self, session_id: int, event: AnyEvent) -> None:
        """The station said that something happened; answers and greetings are not for the book."""
        if isinstance(event, StateChanged):
            self.note(session_id, "state", event.reason, before=event.before.value, after=event.after.value)
        elif isinstance(event, Warned):
            self.note(session_id, "warning", event.text, code=event.code)

    def note_score(self, session_id: int, picture: GameView) -> None:
        """The game counted a hit or a miss."""
        kept = ("game", "exercise", "hits", "misses", "score", "level")
        counted = {name: getattr(picture, name) for name in kept}
        self.note(session_id, SCORE, ", ".join(picture.feedback), **counted)

    async def written(self) -> None:
        """Wait until everything noted so far is stored or given up."""
        await self._waiting.join()

    async def _write(self) -> None:
        while True:
            event = await self._waiting.get()
            try:
                await self._store(event)
            finally:
                self._waiting.task_done()

    async def _store(self, event: Event) -> None:
        for _ in range(TRIES):
            try:
                await run_in_threadpool(self._store_now, event)
            except DatabaseError as error:
                log.warning("an event waits: %s", error)
                await asyncio.sleep(RETRY_S)
            else:
                return
        log.error("an event was not stored: %s %s", event.kind, event.text)

    def _store_now(self, event: Event) -> None:
        with self._database.session() as session:
            sessions.add_event(session, Event(**event.model_dump(exclude={"id"})))
