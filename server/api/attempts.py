"""What was attempted in a session's games, as figures are made of it."""

from __future__ import annotations

from collections.abc import Iterable

from fusion.metrics.record import Attempt
from games.game import Trial


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
