"""docs/exoskeletons.md has every key of the exoskeleton file, with its default."""

from __future__ import annotations

import re
from pathlib import Path

import msgspec
import pytest

from server.exoskeleton import Cia402Settings, Exoskeleton, ExoskeletonJoint, RosbridgeSettings

PAGE = (Path(__file__).parents[2] / "docs" / "exoskeletons.md").read_text("utf-8")
ROWS = {
    name: [cell.strip() for cell in line.strip("|").split("|")]
    for line in PAGE.splitlines()
    if line.startswith("| `")
    for name in re.findall(r"`(?:\[+)?(\w+)(?:\]+)?`", line.split("|")[1])
}
KEYS = [
    field
    for form in (Exoskeleton, ExoskeletonJoint, Cia402Settings, RosbridgeSettings)
    for field in msgspec.structs.fields(form)
]


@pytest.mark.parametrize("field", KEYS, ids=lambda field: field.name)
def test_every_key_is_on_the_page_with_its_default(field) -> None:
    default = ROWS[field.name][2].strip("`")
    if field.required:
        assert default == "required"
    elif isinstance(field.default, float | int):
        assert float(default) == field.default
