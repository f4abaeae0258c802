"""The `mirrorlimb` command: gathers the commands and turns errors into sentences and exit codes."""

from __future__ import annotations

import os
import sys
from importlib import import_module
from typing import Any

import typer
from rich.console import Console
from typer.core import TyperGroup

from db.errors import DatabaseError
from fusion.errors import MirrorlimbError
from server import __version__

UNUSABLE = 2
"""Exit code for input or a machine that cannot be used."""

COMMANDS = (
    "serve",
    "exoskeleton",
    "emulate",
    "replay",
    "score",
    "fuse",
    "evaluate",
    "locate",
    "arm",
    "experiments",
    "bench",
    "convert",
    "doctor",
)
"""Each is a function, or a group of commands, of its name in a module of its name."""


class _Commands(TyperGroup):
    """Loads a command's module when it is asked for: what one needs takes longer to load than another one runs.

    Contexts and commands are click's, which typer carries inside or stands on, depending on its version.
    """

    def list_commands(self, ctx: Any) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        if cmd_name not in COMMANDS:
            return None
        found = getattr(import_module(f"server.cli.{cmd_name}"), cmd_name)
        if isinstance(found, typer.Typer):
            return typer.main.get_command(found)
        alone = typer.Typer(add_completion=False, pretty_exceptions_enable=False)
        alone.command(cmd_name)(found)
        return typer.main.get_command(alone)


app = typer.Typer(
    cls=_Commands,
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    help="Mirror therapy with several sensors and an exoskeleton. Research software, not a medical device.",
)


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
