"""The drive families by name. A new family is a new file and a line here; it is imported only when it is asked for."""

from __future__ import annotations

from importlib import import_module
from typing import cast

from fusion.errors import InputError
from server.config import StationConfig
from server.station.exo.driver import Drive

DRIVES = {"simulated": ("server.station.exo.simulated", "SimulatedDrive")}
"""Name to module and class; the class is made from the device's limits."""


def make_drive(config: StationConfig) -> Drive:
    """The drive that the configuration names, not yet open.

    Raises:
        InputError: no drive has that name.
    """
    if config.drive not in DRIVES:
        raise InputError(f"station.drive: there is no drive '{config.drive}'", f"one of {', '.join(DRIVES)}")
    module, name = DRIVES[config.drive]
    return cast(Drive, getattr(import_module(module), name)(config.device))
