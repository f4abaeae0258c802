"""Attempts in games become each game's figures."""

from __future__ import annotations

import numpy as np
import pytest

from fusion.metrics.attempts import attempt_metrics
from fusion.metrics.metric import ADAPTED, PASSIVE_DRIVE, Metric
from fusion.metrics.record import Attempt, DriveTrack, SessionRecord
from fusion.skeleton import Side

TICKS = 10
REACHED = [Attempt("reach", True, 0.4, 5.0, 0.4 + 0.01 * k, 1.2, 1.3, None, 0.012) for k in range(8)]
TIMED_OUT = [Attempt("reach", False, 0.5, 8.0, 3.0, 5.0, 9.0, None, None)] * 2
TRACED = [Attempt("trace", True, 0.2, 6.0, None, None, 1.1, 0.03, None)]


def played(*attempts: Attempt, assistance: str = "free") -> dict[tuple[str, str | None], Metric]:
    """The figures of a short session, by name and game."""
    still = np.zeros((TICKS, 4))
    session = SessionRecord(
        t_s=np.arange(TICKS) / 50,
        state=np.full(TICKS, "engaged"),
        healthy_side=Side.LEFT,
        healthy_rad=still,
        healthy_valid=np.ones(TICKS, dtype=bool),
        affected_rad=still,
        hand_in_trunk=np.zeros((TICKS, 3)),
        trunk_displacement_m=np.zeros(TICKS),
        sensors=(),
        hits=0,
        misses=0,
        drive=DriveTrack(still, still, still, still, np.full(TICKS, assistance), np.zeros(TICKS)),
        attempts=attempts,
    )
    return {(metric.name, metric.joint): metric for metric in attempt_metrics(session)}


def test_each_game_has_figures_of_its_own() -> None:
    figures = played(*REACHED, *TIMED_OUT, *TRACED)
    said = {key: metric.value for key, metric in figures.items()}
    assert said["repetitions", None] == 11
    assert said["game_repetitions", "reach"] == 10
    assert said["game_success", "reach"] == pytest.approx(0.8)
    assert said["game_level", "reach"] == pytest.approx(0.42)
    assert said["reaction_time", "reach"] == pytest.approx(0.435)
    assert said["hold_stability", "reach"] == pytest.approx(0.012)
    assert said["accuracy", "trace"] == pytest.approx(0.03)
    assert ("accuracy", "reach") not in said


def test_what_a_failed_attempt_took_is_not_counted() -> None:
    figures = played(*REACHED, *TIMED_OUT)
    assert figures["game_path_ratio", "reach"].value == pytest.approx(1.3)
    assert figures["game_movement_time", "reach"].value == pytest.approx(1.2)


def test_they_are_the_shown_hands_and_say_when_the_drive_moved_it() -> None:
    passive, alone = played(*REACHED, assistance="passive"), played(*REACHED)
    assert passive["reaction_time", "reach"].side is Side.RIGHT
    assert passive["reaction_time", "reach"].caveat_key == PASSIVE_DRIVE
    assert alone["reaction_time", "reach"].caveat_key is None
    assert alone["hold_stability", "reach"].caveat_key is None
    assert alone["game_success", "reach"].caveat_key == ADAPTED


def test_of_one_attempt_nobody_knows_how_sure_it_is() -> None:
    figures = played(*REACHED, *TRACED)
    assert figures["reaction_time", "reach"].sem is not None
    assert figures["accuracy", "trace"].sem is None


def test_a_session_without_games_has_none_of_them() -> None:
    assert not played()
