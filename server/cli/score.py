"""`mirrorlimb score`: plays a session's games once more from their inputs, and says what they came to."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from db.exercise import PlayedExercise
from server import __version__
from server.api.game_log import game_log_of, read_game
from server.api.tally import play_again

RECORDING = ".mcap"


def score(
    session: Annotated[Path, typer.Argument(help="A session's .game file, or its recording.", show_default=False)],
) -> None:
    """Print what every exercise of a session came to, worked out anew from its inputs."""
    file = game_log_of(session) if session.suffix == RECORDING else session
    written_by = read_game(file).version
    played = play_again(file).exercises
    for number, exercise in enumerate(played, 1):
        typer.echo(_line(number, exercise))
    typer.echo(f"{file}: {sum(one.score for one in played)} points in {len(played)} exercises.")
    if written_by != __version__:
        typer.echo(f"It was written by version {written_by}; this is {__version__}, whose games may differ.", err=True)


def _line(number: int, played: PlayedExercise) -> str:
    attempts = played.hits + played.misses
    return (
        f"{number}. {played.game}: {played.score} points, {played.hits} of {attempts} attempts, "
        f"level {played.level:.2f}, {played.played_s / 60.0:.1f} minutes of play"
    )
