"""Reads a TOML or JSON file into a typed form; what cannot be used is named with file and key."""

from __future__ import annotations

import difflib
import re
import tomllib
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, Literal, TypeVar, get_args, get_origin

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
        InputError: a key or value in it cannot be used; names file and key, and the nearest that there is.
    """
    try:
        return msgspec.convert(content, form)
    except msgspec.ValidationError as error:
        wrong, _, place = str(error).partition(" - at ")
        inside = place.strip("`").removeprefix("$").lstrip(".")
        raise _refusal(f"'{path}'", wrong, inside, form, content) from None


def nearest(word: str, known: Sequence[str]) -> str:
    """A suggestion for a slip of the pen; "" where nothing is near."""
    begun = [name for name in known if word and name.startswith(word)]
    near = begun or difflib.get_close_matches(word, list(known), n=1)
    return f"'{near[0]}'" if near else ""


def _refusal(file: str, wrong: str, inside: str, form: type[Any], content: dict[str, Any]) -> InputError:
    """Turn what msgspec says into a sentence that names file and key."""
    holder = _named(inside, content)
    unknown = re.match(r"Object contains unknown field `(.+)`", wrong)
    if unknown:
        known = [field.name for field in msgspec.structs.fields(_form_at(form, inside))]
        meant = nearest(unknown[1], known)
        return InputError(f"{file}: there is no key '{_key(inside, unknown[1])}'{holder}", _one_of(known), meant)
    missing = re.match(r"Object missing required field `(.+)`", wrong)
    if missing:
        expected = _choices(_form_at(form, _key(inside, missing[1])))
        return InputError(
            f"{file}: the key '{_key(inside, missing[1])}' is missing{holder}",
            f"{missing[1]}: {_one_of(expected)}" if expected else f"a value for {missing[1]}",
        )
    what = f"{file}: the value of '{inside or 'the file'}' cannot be used{holder}"
    if wrong.startswith("Invalid enum value"):
        choices, given = _choices(_form_at(form, inside)), wrong.removeprefix("Invalid enum value ").strip("'")
        return InputError(f"{what}: {given}", _one_of(choices), nearest(given, choices))
    return InputError(what, wrong.removeprefix("Expected "))


def _key(inside: str, name: str) -> str:
    return f"{inside}.{name}".lstrip(".")


def _one_of(names: Iterable[str]) -> str:
    return f"one of {', '.join(names)}"


def _named(inside: str, content: dict[str, Any]) -> str:
    """Such as " ('elbow')", where the place lies in an entry of a list that has a name."""
    place: Any = content
    name = ""
    for key, index in re.findall(r"(\w+)(?:\[(\d+)\])?", inside):
        place = place.get(key) if isinstance(place, dict) else None
        if index and isinstance(place, list):
            place = place[int(index)]
            name = place.get("name", "") if isinstance(place, dict) else ""
    return f" ('{name}')" if name else ""


def _choices(kind: Any) -> list[str]:
    """What a type allows, where that is a list."""
    members = getattr(kind, "__members__", {}).values() or (get_args(kind) if get_origin(kind) is Literal else ())
    return [str(member) for member in members]


def _form_at(form: Any, inside: str) -> Any:
    for name in filter(None, re.sub(r"\[.*?\]", "", inside).split(".")):
        inner = next(field.type for field in msgspec.structs.fields(form) if field.name == name)
        holds_more = get_args(inner) and get_origin(inner) is not Literal
        form = get_args(inner)[0] if holds_more else inner
    return form
