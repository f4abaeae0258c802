"""What the games' attempts say, of the shown (affected) hand."""

from __future__ import annotations

from fusion.metrics.measure import OURS, SCHWARZ, SRRR_2, Better, Measure, Trust

SUCCEEDED = "median over the game's successful attempts of"
OF_GAMES = "none: the shown hand's place is computed from the exoskeleton's encoders and the arm's learnt lengths"

MEASURES = (
    Measure("targets_collected", "1", "attempts that succeeded, all games", OURS, Trust.GOOD, "trust.exact"),
    Measure("targets_missed", "1", "attempts that failed, all games", OURS, Trust.GOOD, "trust.exact"),
    Measure(
        "success_rate",
        "1",
        "successful attempts / all attempts, all games; difficulty is adapted to keep it near 75 %",
        f"task success: {SCHWARZ}",
        Trust.GOOD,
        "trust.exact",
    ),
    Measure("repetitions", "1", "attempts in all games", OURS, Trust.GOOD, "trust.exact", Better.MORE),
    Measure("game_repetitions", "1", "attempts in the game", OURS, Trust.GOOD, "trust.exact", Better.MORE),
    Measure("game_success", "1", "successful attempts / attempts of the game", OURS, Trust.GOOD, "trust.exact"),
    Measure(
        "game_level",
        "1",
        "mean difficulty of the game's attempts, 0 to 1: what success near 75 % was reached at",
        OURS,
        Trust.GOOD,
        "trust.exact",
        Better.MORE,
    ),
    Measure(
        "reaction_time",
        "s",
        f"{SUCCEEDED} the time from its appearing until the hand set out; contains the delay of sensors and picture",
        f"{SRRR_2}; {SCHWARZ}",
        Trust.FAIR,
        "trust.reaction",
        Better.LESS,
        OF_GAMES,
    ),
    Measure(
        "game_movement_time",
        "s",
        f"{SUCCEEDED} the time from the hand's setting out to the end",
        f"{SRRR_2}; {SCHWARZ}",
        Trust.GOOD,
        "trust.shown_hand",
        Better.LESS,
        OF_GAMES,
    ),
    Measure(
        "game_path_ratio",
        "1",
        f"{SUCCEEDED} the hand's path divided by the straight line from its start to its end",
        f"{SRRR_2}; {SCHWARZ}",
        Trust.GOOD,
        "trust.shown_hand",
        Better.LESS,
        OF_GAMES,
    ),
    Measure(
        "accuracy",
        "m",
        f"{SUCCEEDED} the distance from the ideal, as the game defines it (docs/games.md); smaller is better",
        f"end-point or path error: {SCHWARZ}",
        Trust.GOOD,
        "trust.shown_hand",
        Better.LESS,
        OF_GAMES,
    ),
    Measure(
        "hold_stability",
        "m",
        f"{SUCCEEDED} the root mean square of the hand about its mean while it was to be still",
        OURS,
        Trust.GOOD,
        "trust.shown_hand",
        Better.LESS,
        OF_GAMES,
    ),
)
