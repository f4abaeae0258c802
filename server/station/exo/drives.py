"""The drive families by name. A new family is a new file and a line here; it is imported only when it is asked for."""

from __future__ import annotations

from importlib import import_module
from typing import cast

from fusion.errors import InputError
from server.exoskeleton import Exoskeleton
from server.station.exo.driver import Drive

DRIVES = {
    "simulated": ("server.station.exo.simulated", "SimulatedDrive"),
    "cia402": ("server.station.exo.cia402", "Cia402Drive"),
    "rosbridge": ("server.station.exo.rosbridge.drive", "RosbridgeDrive"),
}
"""Name to module and class; the class is made from an `Exoskeleton`."""


def make_drive(exoskeleton: Exoskeleton) -> Drive:
    """The drive that an exoskeleton names, not yet open.

    Raises:
        InputError: no drive has that name.
    """
    if exoskeleton.drive not in DRIVES:
        raise InputError(
            f"the exoskeleton '{exoskeleton.name}': there is no drive '{exoskeleton.drive}'",
            f"one of {', '.join(DRIVES)}",
            "mend 'drive' in the exoskeleton file",
        )
    module, name = DRIVES[exoskeleton.drive]
    return cast(Drive, getattr(import_module(module), name)(exoskeleton))
