"""Reads a TOML or JSON file into a typed form; what cannot be used is named with file and key."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any, TypeVar, get_args

import msgspec

from fusion.errors import InputError

Form = TypeVar("Form", bound=msgspec.Struct)


def read_content(path: Path, kind: str, see: str) -> dict[str, Any]:
    """What a file says, untyped.

    Args:
        path: of the file; ".json" is JSON, everything else TOML.
        kind: what it is called in an error, such as "configuration".
        see: where its form is described.

    Raises:
        InputError: it cannot be read or is not well-formed.
    """
    try:
        text = path.read_text("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        why = error.strerror if isinstance(error, OSError) else "it is not UTF-8 text"
        raise InputError(f"The {kind} '{path}' cannot be read: {why}", "a TOML file", "check its name") from None
    try:
        content: dict[str, Any] = msgspec.json.decode(text) if path.suffix == ".json" else tomllib.loads(text)
    except (tomllib.TOMLDecodeError, msgspec.DecodeError) as error:
        raise InputError(f"'{path}' is not well-formed: {error}", f"TOML, as in {see}") from None
    return content


def typed(content: dict[str, Any], form: type[Form], path: Path) -> Form:
    """The content as a form.

    Raises:
        InputError: a key or value in it cannot be used; names file and key.
    """
    try:
        return msgspec.convert(content, form)
    except msgspec.ValidationError as error:
        raise _bad_value(path, str(error), form) from None


def _bad_value(path: Path, message: str, form: type[msgspec.Struct]) -> InputError:
    """Turn "Expected `int`, got `str` - at `$.station.rate_hz`" into a sentence that names file and key."""
    expected, _, place = message.partition(" - at ")
    inside = place.strip("`").removeprefix("$").lstrip(".")
    unknown = re.match(r"Object contains unknown field `(.+)`", expected)
    if unknown:
        known = ", ".join(field.name for field in msgspec.structs.fields(_form_at(form, inside)))
        key = f"{inside}.{unknown[1]}".lstrip(".")
        return InputError(f"'{path}': there is no key '{key}'", f"one of {known}")
    missing = re.match(r"Object missing required field `(.+)`", expected)
    if missing:
        key = f"{inside}.{missing[1]}".lstrip(".")
        return InputError(f"'{path}': the key '{key}' is missing", _about(_form_at(form, inside), missing[1]))
    return InputError(
        f"'{path}': the value of '{inside or 'the file'}' cannot be used", expected.removeprefix("Expected ")
    )


def _about(form: type[msgspec.Struct], key: str) -> str:
    wanted = next(field.type for field in msgspec.structs.fields(form) if field.name == key)
    choices = get_args(wanted) if not isinstance(wanted, type) else tuple(getattr(wanted, "__members__", {}).values())
    plain = [str(choice) for choice in choices if isinstance(choice, str | int)]
    return f"{key}: one of {', '.join(plain)}" if plain else f"a value for {key}"


def _form_at(form: type[Any], inside: str) -> type[Any]:
    for name in filter(None, re.sub(r"\[.*?\]", "", inside).split(".")):
        inner = next(field.type for field in msgspec.structs.fields(form) if field.name == name)
        form = get_args(inner)[0] if get_args(inner) else inner
    return form
