"""Changes single values in an exoskeleton file's text, so that its comments and order stay."""

from __future__ import annotations

import os
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import msgspec

from server.exoskeleton import Exoskeleton

Changes = Mapping[int, Mapping[str, float]]
"""Index of a joint → key → new value."""

_TABLE = re.compile(r"\s*\[")
_JOINT = re.compile(r"\s*\[\[\s*joints\s*\]\]")


def changed(exoskeleton: Exoskeleton, changes: Changes) -> Exoskeleton:
    """The device with other values."""
    joints = tuple(
        msgspec.structs.replace(joint, **changes.get(index, {})) for index, joint in enumerate(exoskeleton.joints)
    )
    return msgspec.structs.replace(exoskeleton, joints=joints)


def edited(text: str, changes: Changes) -> str | None:
    """The text with the values changed; None where it is written in a way in which that cannot be done safely."""
    lines = text.splitlines(keepends=True)
    starts = [i for i, line in enumerate(lines) if _JOINT.match(line)]
    for index in sorted(changes, reverse=True):  # from the end, so that what is inserted moves nothing
        if index >= len(starts):
            return None
        for key, value in changes[index].items():
            _set(lines, starts[index] + 1, key, f"{value:g}")
    result = "".join(lines)
    return result if _differs_by(text, result, changes) else None


def write(path: Path, text: str) -> None:
    """Replace a file in one go: a crash leaves the old one or the new one."""
    beside = path.with_name(f".{path.name}.new")
    beside.write_text(text, "utf-8")
    os.replace(beside, path)


def _set(lines: list[str], begin: int, key: str, value: str) -> None:
    """Put a value in place of the one in the table that begins there; a key that is not there is its first."""
    end = next((i for i in range(begin, len(lines)) if _TABLE.match(lines[i])), len(lines))
    pattern = re.compile(rf"(\s*{key}\s*=\s*)([^#\s]+)(.*)", re.DOTALL)
    for i in range(begin, end):
        found = pattern.fullmatch(lines[i])
        if found:
            lines[i] = f"{found[1]}{value}{found[3]}"
            return
    lines.insert(begin, f"{key} = {value}\n")


def _differs_by(before: str, after: str, changes: Changes) -> bool:
    """Whether the texts mean the same but for the changes."""
    try:
        wanted, got = tomllib.loads(before), tomllib.loads(after)
    except tomllib.TOMLDecodeError:
        return False
    joints: list[dict[str, Any]] = wanted["joints"]
    for index, values in changes.items():
        joints[index] |= {key: float(f"{value:g}") for key, value in values.items()}
    return wanted == got
