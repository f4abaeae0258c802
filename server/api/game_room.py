"""Plays the open session's games: opens them beside the event loop, looks for the patient's screen, notes the score."""

from __future__ import annotations

import asyncio
import logging

from fastapi.concurrency import run_in_threadpool

from games.game import GameView
from server.api.authority import Presence
from server.api.course import Course, counted
from server.api.journal import Journal
from server.messages import LiveTick

log = logging.getLogger(__name__)


class GameRoom:
    """Where one session's games are played at a time.

    Args:
        journal: where scores, and screens that come and go, are noted.
        presence: which pages show the games to the patient.
    """

    def __init__(self, journal: Journal, presence: Presence) -> None:
        self._journal, self._presence = journal, presence
        self._opening: asyncio.Task[None] | None = None

    def step(self, course: Course, tick: LiveTick) -> None:
        """Take a tick."""
        self._look_for_screens(course)
        before, after = course.picture, self._stepped(course, tick)
        if after is not None and counted(after) != counted(before):
            self._journal.note_score(course.opening.id, after)
        if course.lacks_games:
            course.games_asked = True
            self._opening = asyncio.create_task(self._open(course, tick), name="games")

    def _stepped(self, course: Course, tick: LiveTick) -> GameView | None:
        """A game's mistake costs the games; without a tick the pages would be taken for lost, and the arm be held."""
        try:
            return course.step(tick)
        except Exception as error:
            if not course.games_broke:
                log.exception("the games of session %d have ended by a mistake", course.opening.id)
                self._journal.note(course.opening.id, "no games", f"the program made a mistake in a game: {error}")
            course.games_broke = True
            return course.picture

    async def close(self, course: Course) -> None:
        """No more is played: whatever was is written down."""
        if self._opening is not None:
            await self._opening
            self._opening = None
        if course.playing is None:
            return
        await run_in_threadpool(course.playing.log.close)
        if course.playing.log.trouble:
            self._journal.note(course.opening.id, "not logged", course.playing.log.trouble)

    async def _open(self, course: Course, tick: LiveTick) -> None:
        """What the games ask for is drawn in a thread: a heart that beats late would hold the arm (SR-9)."""
        try:
            course.playing = await run_in_threadpool(course.open_games, tick)
        except Exception as error:  # whatever it is, the session must still be ended and measured
            log.exception("the games of session %d could not be opened", course.opening.id)
            self._journal.note(course.opening.id, "no games", str(error))

    def _look_for_screens(self, course: Course) -> None:
        before, now = course.screens.count, self._presence.patient_screens
        if course.see_screens(now):
            self._journal.note(course.opening.id, "screen", "the patient's screen has gone; the game waits", screens=0)
        elif now != before:
            self._journal.note(course.opening.id, "screen", f"{now} of the patient's screens are there", screens=now)
