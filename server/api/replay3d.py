"""A past session in a 3-D view of its own: opened when somebody asks, closed when nobody looks or a session opens."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from time import monotonic

import viser
from fastapi.concurrency import run_in_threadpool

from db.database import Database
from db.queries import sessions
from db.therapy_session import SessionStatus
from fusion.errors import RefusedError
from server.api import session_store
from server.api.replay3d_clock import ReplayClock
from server.api.replay3d_forms import ReplayForm, ReplayPublic, Timeline
from server.api.replay3d_frames import Frames, read_frames
from server.api.replay3d_marks import marks_of, spans_of
from server.api.view3d import PERIOD_S, close_viser, open_viser, show
from server.api.view3d_scene import Scene, Shown

UNUSED_S = 60.0
"""Without a page that looks for so long, viser and the recording are let go."""
EVERYTHING = Shown(sensors=True, bounds=False)


@dataclass(frozen=True, slots=True)
class _Reel:
    """A session, ready to be shown."""

    frames: Frames
    timeline: Timeline


class Replay:
    """One replay at a time, for everybody who looks.

    Args:
        data: the data folder.
        database: where sessions are kept.
        is_treating: whether a session is open; the machine then belongs to the arm.
    """

    def __init__(self, data: Path, database: Database, is_treating: Callable[[], bool]) -> None:
        self._data, self._database, self._is_treating = data, database, is_treating
        self._turn = asyncio.Lock()
        self._reel: _Reel | None = None
        self._clock = ReplayClock(0.0, 0.0)
        self._task: asyncio.Task[None] | None = None
        self._server: viser.ViserServer | None = None
        self.port = 0
        """viser's port on the loopback address; 0 while nothing is shown."""

    async def play(self, form: ReplayForm) -> ReplayPublic:
        """Show a session, or change how it runs.

        Raises:
            ApiError: there is no such session.
            RefusedError: a session is open, this one or another.
            RecordingError: the recording cannot be read.
        """
        async with self._turn:
            self._refuse_while_treating()
            if self._reel is None or self._reel.timeline.session_id != form.session_id:
                reel = await run_in_threadpool(self._read, form.session_id)
                await self._put_away()
                await self._begin(reel)
            self._clock = self._clock.changed(monotonic(), form.t_s, form.playing, form.speed)
            return self._stands(form.session_id)

    def view(self) -> ReplayPublic | None:
        """How it stands; None while nothing is shown."""
        return None if self._reel is None else self._stands(self._reel.timeline.session_id)

    def timeline(self) -> Timeline | None:
        """What is marked on the time line; None while nothing is shown."""
        return None if self._reel is None else self._reel.timeline

    async def close(self) -> None:
        """Put away what is shown."""
        async with self._turn:
            await self._put_away()

    def _stands(self, session_id: int) -> ReplayPublic:
        now_s = monotonic()
        return ReplayPublic(
            session_id=session_id,
            duration_s=self._clock.duration_s,
            t_s=self._clock.at(now_s),
            playing=self._clock.plays(now_s),
            speed=self._clock.speed,
        )

    def _refuse_while_treating(self) -> None:
        if self._is_treating():
            raise RefusedError(
                "a session is open, and this machine is needed for the arm",
                "a replay while nobody is treated",
                "end the session first",
            )

    def _read(self, session_id: int) -> _Reel:
        found = session_store.existing_session(self._database, session_id)
        if found.status is SessionStatus.OPEN:
            raise RefusedError(f"session {session_id} is still open", "a session that has ended", "end it first")
        frames = read_frames(self._data / found.recording, lambda: not self._is_treating())
        spans = spans_of(frames)
        with self._database.session() as session:
            marks = marks_of(sessions.events_of(session, session_id), spans, found.started_at)
        return _Reel(frames, Timeline(session_id=session_id, duration_s=frames.duration_s, spans=spans, marks=marks))

    async def _begin(self, reel: _Reel) -> None:
        self._server = await asyncio.to_thread(open_viser)
        self._reel, self.port = reel, self._server.get_port()
        self._clock = ReplayClock(reel.frames.duration_s, monotonic())
        self._task = asyncio.create_task(self._show(reel.frames, self._server), name="replay")

    async def _put_away(self) -> None:
        if self._task is not None:
            self._task.cancel()
            await asyncio.gather(self._task, return_exceptions=True)
        await self._let_go()

    async def _let_go(self) -> None:
        server, self._server = self._server, None
        self._reel, self.port = None, 0
        if server is not None:
            await asyncio.to_thread(close_viser, server)

    async def _show(self, frames: Frames, server: viser.ViserServer) -> None:
        try:
            await self._draw(frames, server, Scene(server))
        finally:
            await self._let_go()

    async def _draw(self, frames: Frames, server: viser.ViserServer, scene: Scene) -> None:
        seen_s, drawn_s = monotonic(), -1.0
        while not self._is_treating() and monotonic() - seen_s < UNUSED_S:
            t_s = self._clock.at(monotonic())
            if server.get_clients():
                seen_s = monotonic()
            if t_s != drawn_s:
                show(server, scene, frames.at(t_s), EVERYTHING)
                drawn_s = t_s
            await asyncio.sleep(PERIOD_S)
