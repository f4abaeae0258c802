"""What was attempted in a session's games, from their file beside the recording."""

from __future__ import annotations

import logging
from pathlib import Path

from fusion.errors import MirrorlimbError
from fusion.metrics.record import Attempt
from games.game import Trial
from server.api.game_log import game_log_of, played

log = logging.getLogger(__name__)


def attempts_of(recording: Path) -> tuple[Attempt, ...]:
    """Every attempt, in order; none where no games were logged. A file that cannot be played again costs these figures
    alone: the others come from the recording.
    """
    games = game_log_of(recording)
    if not games.is_file():
        return ()
    try:
        return tuple(_attempt(trial) for trial in played(games).trials)
    except MirrorlimbError as error:
        log.warning("no figures of the games: %s", error)
        return ()


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
