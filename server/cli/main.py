"""The `mirrorlimb` command: gathers the commands and turns errors into sentences and exit codes."""

from __future__ import annotations

import typer

app = typer.Typer(no_args_is_help=True, add_completion=False)


def main() -> None:
    """Entry point of the installed command."""
    app()
