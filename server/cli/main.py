"""The `mirrorlimb` command: gathers the commands and turns errors into sentences and exit codes."""

from __future__ import annotations

import os
import sys

import typer
from rich.console import Console

from db.errors import DatabaseError
from fusion.errors import MirrorlimbError
from server import __version__
from server.cli.arm import arm
from server.cli.bench import bench
from server.cli.convert import convert
from server.cli.doctor import doctor
from server.cli.evaluate import evaluate
from server.cli.fuse import fuse
from server.cli.locate import locate
from server.cli.replay import replay
from server.cli.serve import serve

UNUSABLE = 2
"""Exit code for input or a machine that cannot be used."""

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    help="Mirror therapy with several sensors and an exoskeleton. Research software, not a medical device.",
)
for command in (serve, replay, fuse, evaluate, locate, arm, bench, convert, doctor):
    app.command(command.__name__)(command)


def _show_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"mirrorlimb {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: bool = typer.Option(
        False, "--version", callback=_show_version, is_eager=True, help="Print the version and exit."
    ),
) -> None:
    """Hold the options that stand before a command."""


def main() -> None:
    """Entry point of the installed command: 0 on success, 2 on input or a machine that cannot be used."""
    try:
        app()
    except (MirrorlimbError, DatabaseError) as error:
        _say(f"{error}")
        sys.exit(UNUSABLE)
    except KeyboardInterrupt:
        sys.exit(130)
    except BrokenPipeError:
        # The reader (`| head`) has gone; keep Python from complaining about it at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(0)


def _say(sentence: str) -> None:
    Console(stderr=True, soft_wrap=True, highlight=False, markup=False).print(f"mirrorlimb: {sentence}")
