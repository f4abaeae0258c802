"""What was attempted in a session's games, as figures are made of it."""

from __future__ import annotations

import logging
from collections.abc import Iterable
from pathlib import Path

from fusion.errors import MirrorlimbError
from fusion.metrics.record import Attempt
from games.game import Trial
from server.api.game_log import game_log_of, played

log = logging.getLogger(__name__)


def attempts_again(recording: Path) -> tuple[Attempt, ...]:
    """Every attempt of the games' file beside a recording, played again; none where no games were logged.

    A file that cannot be played again costs these figures alone: the others come from the recording.
    """
    games = game_log_of(recording)
    if not games.is_file():
        return ()
    try:
        return as_attempts(played(games).trials)
    except MirrorlimbError as error:
        log.warning("no figures of the games: %s", error)
        return ()


def as_attempts(trials: Iterable[Trial]) -> tuple[Attempt, ...]:
    """Attempts as figures are made of them."""
    return tuple(_attempt(trial) for trial in trials)


def _attempt(trial: Trial) -> Attempt:
    return Attempt(
        game=trial.game,
        success=trial.success,
        level=trial.level,
        duration_s=trial.duration_s,
        reaction_s=trial.reaction_s,
        movement_s=trial.movement_s,
        path_ratio=trial.path_ratio,
        error_m=trial.error_m,
        hold_m=trial.hold_m,
    )
