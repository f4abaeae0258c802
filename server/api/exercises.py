"""Which exercises a session begins with."""

from __future__ import annotations

from collections.abc import Iterable

from sqlmodel import Session

from db.exercise import Exercise
from db.queries import plans, sessions
from fusion.errors import InputError
from games.catalogue import GAMES

WITHOUT_A_PLAN = (Exercise(game="reach", minutes=6.0),)
"""What is played where neither a plan nor whoever opens the session says anything."""
FIRST_LEVEL = 0.2
"""Difficulty of a game that the patient has never played."""


def exercises_for(session: Session, patient_id: int, wanted: tuple[Exercise, ...] | None) -> tuple[Exercise, ...]:
    """What is wanted, else the patient's plan, else `WITHOUT_A_PLAN`; every exercise with the level it begins at, which
    is the one that the patient last reached in that game where nobody has said another.

    Raises:
        InputError: there is no such game.
    """
    plan = plans.find_plan(session, patient_id)
    chosen = wanted or (WITHOUT_A_PLAN if plan is None else plan.exercises)
    check_games(chosen)
    reached = sessions.levels_reached(session, patient_id)
    return tuple(_levelled(exercise, reached.get(exercise.game, FIRST_LEVEL)) for exercise in chosen)


def _levelled(exercise: Exercise, reached: float) -> Exercise:
    return exercise if exercise.level is not None else exercise.model_copy(update={"level": reached})


def check_games(exercises: Iterable[Exercise]) -> None:
    """Refuse games that there are not.

    Raises:
        InputError: there is no such game.
    """
    unknown = sorted({exercise.game for exercise in exercises} - set(GAMES))
    if unknown:
        raise InputError(
            f"there is no game '{unknown[0]}'",
            f"one of {', '.join(sorted(GAMES))}",
            "choose one of these; where the patient's plan names it, change the plan",
        )
