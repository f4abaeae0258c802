"""What a session's recording says of it: figures, stored once, and curves, read when somebody asks."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from fastapi.concurrency import run_in_threadpool

from db.database import Database
from db.errors import DatabaseError
from db.therapy_session import SessionStatus, TherapySession
from fusion.errors import MirrorlimbError
from fusion.skeleton import Side
from games.game import Trial
from server.api import session_store
from server.api.attempts import as_attempts
from server.api.forms import Curves
from server.api.game_log import game_log_of
from server.api.journal import Journal
from server.api.measure import measure, read_curves
from server.api.tally import play_again

log = logging.getLogger(__name__)


class Figures:
    """Reads recordings in worker threads.

    Args:
        data: the data folder.
        database: where sessions are kept.
        journal: where it is noted that something could not be measured.
    """

    def __init__(self, data: Path, database: Database, journal: Journal) -> None:
        self._data, self._database, self._journal = data, database, journal

    async def measure(self, session_id: int, trials: Sequence[Trial] | None = None) -> None:
        """Store what a session's recording says was measured; what fails is tried again at the next start.

        Args:
            session_id: of a session that is over.
            trials: of its games; None = they are played again from their file, which takes a while.
        """
        try:
            await run_in_threadpool(self._measure_now, session_id, trials)
        except Exception as error:  # whatever it is, the session is over and must read so
            expected = isinstance(error, MirrorlimbError | DatabaseError | OSError)
            log.warning("session %d could not be measured: %s", session_id, error, exc_info=not expected)
            self._journal.note(session_id, "not measured", str(error))

    async def curves(self, session_id: int) -> Curves:
        """A session's curves, from its recording.

        Raises:
            ApiError: there is no such session.
            RecordingError: its recording cannot be read.
        """
        found = await run_in_threadpool(session_store.existing_session, self._database, session_id)
        is_over = found.status is not SessionStatus.OPEN
        return await run_in_threadpool(read_curves, self._data / found.recording, is_over)

    def _measure_now(self, session_id: int, trials: Sequence[Trial] | None) -> None:
        found = session_store.existing_session(self._database, session_id)
        attempts = as_attempts(self._trials_again(found) if trials is None else trials)
        counts = replace(session_store.counts(self._database, session_id), attempts=attempts)
        metrics = measure(self._data / found.recording, Side(found.affected_side).other, counts)
        session_store.store_metrics(self._database, session_id, metrics)

    def _trials_again(self, found: TherapySession) -> tuple[Trial, ...]:
        """Every attempt of a session whose end nobody saw; what was played of it is stored on the way.

        A file that cannot be played again costs these figures alone: the others come from the recording.
        """
        games = game_log_of(self._data / found.recording)
        if not games.is_file():
            return ()
        try:
            again = play_again(games)
        except Exception as error:  # also a mistake in a game: it would be made again at every start
            log.warning("no figures of the games of session %d: %s", found.id, error)
            return ()
        if not found.played:
            session_store.store_played(self._database, found.id or 0, again.exercises)
        return again.trials
