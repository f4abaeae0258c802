"""The dialects there are, by name and by address."""

from __future__ import annotations

from typing import Final

from fusion.errors import InputError
from fusion.formats.dialect import Dialect
from fusion.formats.kinectv2_osc import KinectV2Osc
from fusion.formats.mirrorlimb_osc import MirrorlimbOsc
from fusion.formats.osceleton2 import Osceleton2

DIALECTS: Final[tuple[Dialect, ...]] = (KinectV2Osc(), Osceleton2(), MirrorlimbOsc())


def dialect_named(name: str) -> Dialect:
    """The dialect of that name; raises InputError listing the known ones."""
    for dialect in DIALECTS:
        if dialect.name == name:
            return dialect
    known = ", ".join(dialect.name for dialect in DIALECTS)
    raise InputError(f"the dialect '{name}' is unknown", f"one of {known}", "check the spelling")


def dialect_of_address(address: str) -> Dialect | None:
    """The dialect that an OSC address belongs to, if any."""
    return next((dialect for dialect in DIALECTS if dialect.claims(address)), None)
