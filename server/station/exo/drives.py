"""The drive families by name. A new family is a new file and a line here; it is imported only when it is asked for."""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from typing import cast

from fusion.errors import InputError, MachineError
from server.exoskeleton import Exoskeleton
from server.station.exo.driver import Drive

DRIVES = {
    "simulated": ("server.station.exo.simulated", "SimulatedDrive"),
    "cia402": ("server.station.exo.cia402", "Cia402Drive"),
    "rosbridge": ("server.station.exo.rosbridge.drive", "RosbridgeDrive"),
}
"""Name to module and class; the class is made from an `Exoskeleton`."""
EXTRAS = {"simulated": ("simulation", ("mujoco",)), "cia402": ("can", ("can", "canopen"))}
"""Name to the extra that it needs, and the modules of that."""


def missing(family: str) -> tuple[str, ...]:
    """What a family needs and is not installed."""
    _, modules = EXTRAS.get(family, ("", ()))
    return tuple(module for module in modules if find_spec(module) is None)


def require(family: str) -> None:
    """Refuse where something that a family needs is not installed.

    Raises:
        MachineError: names it, and the command that installs it.
    """
    absent = missing(family)
    if absent:
        raise MachineError(
            f"The drive '{family}' needs {' and '.join(absent)}, not installed here", "its extra", install(family)
        )


def install(family: str) -> str:
    """The command that installs a family's extra."""
    return f".venv/bin/python -m pip install -e '.[{EXTRAS[family][0]}]'"


def make_drive(exoskeleton: Exoskeleton) -> Drive:
    """The drive that an exoskeleton names, not yet open.

    Raises:
        InputError: no drive has that name.
        MachineError: something that it needs is not installed.
    """
    if exoskeleton.drive not in DRIVES:
        raise InputError(
            f"the exoskeleton '{exoskeleton.name}': there is no drive '{exoskeleton.drive}'",
            f"one of {', '.join(DRIVES)}",
            "mend 'drive' in the exoskeleton file",
        )
    require(exoskeleton.drive)
    module, name = DRIVES[exoskeleton.drive]
    return cast(Drive, getattr(import_module(module), name)(exoskeleton))
