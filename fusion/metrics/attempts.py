"""What the games' attempts say, game by game: reaction, accuracy, steadiness, success and how hard it was."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np

from fusion.messages import Floats
from fusion.metrics.metric import ADAPTED, PASSIVE_DRIVE, Metric
from fusion.metrics.record import Attempt, SessionRecord
from fusion.metrics.uncertainty import bootstrap_sem, share_sem, wandering_sem
from fusion.skeleton import Side

Figure = tuple[str, str, Callable[[Attempt], float | None]]
MEDIANS: Final[tuple[Figure, ...]] = (
    ("reaction_time", "s", lambda one: one.reaction_s),
    ("game_movement_time", "s", lambda one: one.movement_s),
    ("game_path_ratio", "1", lambda one: one.path_ratio),
    ("accuracy", "m", lambda one: one.error_m),
    ("hold_stability", "m", lambda one: one.hold_m),
)


def attempt_metrics(record: SessionRecord) -> list[Metric]:
    """Repetitions in all, and each game's figures."""
    if not record.attempts:
        return []
    games = dict.fromkeys(one.game for one in record.attempts)
    side, driven = record.healthy_side.other, record.is_driven
    each = [_of_game(game, [one for one in record.attempts if one.game == game], side, driven) for game in games]
    return [Metric("repetitions", float(len(record.attempts)), "1"), *(metric for found in each for metric in found)]


def _of_game(game: str, attempts: list[Attempt], side: Side, driven: bool) -> list[Metric]:
    hits = sum(one.success for one in attempts)
    levels = np.array([one.level for one in attempts])
    share = hits / len(attempts)
    return [
        Metric("game_repetitions", float(len(attempts)), "1", game, side),
        Metric("game_success", share, "1", game, side, ADAPTED, share_sem(hits, len(attempts))),
        Metric("game_level", float(levels.mean()), "1", game, side, None, wandering_sem(levels)),
        *_medians(game, attempts, side, driven),
    ]


def _medians(game: str, attempts: list[Attempt], side: Side, driven: bool) -> list[Metric]:
    """Over the attempts that succeeded: a failed one ends when its time is over, whatever the hand did."""
    found = []
    for name, unit, of in MEDIANS:
        values = _known([of(one) for one in attempts if one.success])
        if len(values):
            caveat = PASSIVE_DRIVE if driven else None
            value, sem = float(np.median(values)), bootstrap_sem(values)
            found.append(Metric(name, value, unit, game, side, caveat, sem))
    return found


def _known(values: list[float | None]) -> Floats:
    return np.array([value for value in values if value is not None])
