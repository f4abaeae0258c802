"""Writes a text that somebody asked for."""

from __future__ import annotations

from pathlib import Path

from fusion.errors import MachineError


def write_text(file: Path, text: str) -> None:
    """Write it whole.

    Raises:
        MachineError: the file cannot be written.
    """
    try:
        file.write_text(text, encoding="utf-8")
    except OSError as error:
        raise MachineError(
            f"cannot write {file}: {error.strerror}", "a file in a folder that exists", "name another"
        ) from error
