"""Attempts in a session's games become what figures are made of."""

from games.game import Trial
from server.api.attempts import as_attempts


def test_attempts_say_what_the_games_trials_say():
    trials = tuple(
        Trial(
            number=number,
            game="reach",
            success=number != 2,
            level=0.1 * number,
            duration_s=2.0,
            reaction_s=0.3,
            movement_s=None,
            path_ratio=1.2,
            error_m=0.01,
            hold_m=0.004,
        )
        for number in (1, 2, 3)
    )
    for attempt, trial in zip(as_attempts(trials), trials, strict=True):
        told = {name: getattr(attempt, name) for name in attempt.__dataclass_fields__}
        assert told == {name: getattr(trial, name) for name in told}
