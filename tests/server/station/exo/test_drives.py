"""The drive families by name."""

from __future__ import annotations

import msgspec
import pytest

from fusion.errors import InputError, MachineError
from server.exoskeleton import BUILT_IN, FAMILIES
from server.station.exo import drives


def test_every_family_of_the_file_has_a_drive_that_loads() -> None:
    assert set(drives.DRIVES) == set(FAMILIES)
    assert drives.make_drive(BUILT_IN).name == "simulated"


def test_an_unknown_family_is_named_with_those_there_are() -> None:
    with pytest.raises(InputError, match=r"there is no drive 'steam'.*simulated, cia402, rosbridge"):
        drives.make_drive(msgspec.structs.replace(BUILT_IN, drive="steam"))


def test_what_is_not_installed_is_named_with_the_command_that_installs_it(monkeypatch) -> None:
    monkeypatch.setitem(drives.EXTRAS, "cia402", ("can", ("no_such_module",)))
    with pytest.raises(MachineError, match=r"'cia402' needs no_such_module.*pip install -e '\.\[can\]'"):
        drives.make_drive(msgspec.structs.replace(BUILT_IN, drive="cia402"))
