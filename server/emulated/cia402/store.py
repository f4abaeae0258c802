"""An emulated drive's objects: what it is shipped with, and what the station has written."""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Final

from canopen import ObjectDictionary
from canopen.sdo.exceptions import SdoAbortedError

from server.station.exo.cia402 import objects
from server.station.exo.cia402.objects import Entry
from server.station.exo.cia402.pdo import PDOS

_NO_OBJECT, _READ_ONLY, _WRONG_LENGTH = 0x06020000, 0x06010002, 0x06070010
_READ_ONLY_OBJECTS: Final = (
    objects.DEVICE_TYPE,
    objects.ERROR_REGISTER,
    objects.LAST_ERROR,
    objects.VENDOR,
    objects.ERROR_CODE,
    objects.STATUSWORD,
    objects.MODE_SHOWN,
    objects.POSITION,
    objects.VELOCITY,
    objects.TORQUE,
    objects.RATED_TORQUE,
    objects.SUPPORTED_MODES,
)
_WRITTEN: Final = (
    objects.CONSUMER_HEARTBEAT,
    objects.PRODUCER_HEARTBEAT,
    objects.ABORT_OPTION,
    objects.CONTROLWORD,
    objects.QUICK_STOP_OPTION,
    objects.FAULT_REACTION_OPTION,
    objects.MODE,
    objects.MAX_TORQUE,
    objects.MAX_CURRENT,
    objects.TARGET_POSITION,
    objects.MIN_POSITION,
    objects.MAX_POSITION,
    objects.POLARITY,
    objects.MAX_PROFILE_VELOCITY,
    objects.MAX_MOTOR_SPEED,
    objects.QUICK_STOP_DECELERATION,
    objects.HOMING_METHOD,
    objects.INTERPOLATION_TIME,
    objects.INTERPOLATION_EXPONENT,
    objects.MAX_ACCELERATION,
)
ERROR_COUNT: Final = Entry(0x1003, 0, "B", "number of errors")
RATED_MOTOR_NM: Final = 0.8


def shipped(counts_per_turn: int) -> dict[Entry, int]:
    """A drive's objects as it comes from its maker."""
    values = dict.fromkeys((*_READ_ONLY_OBJECTS, *_WRITTEN, ERROR_COUNT), 0)
    values[objects.DEVICE_TYPE] = 0x0002_0000 | objects.PROFILE_402
    values[objects.RATED_TORQUE] = round(1000 * RATED_MOTOR_NM)
    values[objects.SUPPORTED_MODES] = objects.MODE_BITS[objects.CYCLIC_POSITION] | objects.MODE_BITS[objects.HOMING]
    values[objects.ENCODER_COUNTS], values[objects.ENCODER_TURNS] = counts_per_turn, 1
    values[objects.MAX_TORQUE] = 1000
    for pdo in PDOS:
        values |= {entry: 0 for entry, _ in pdo.settings(0)}
    return values


class Store:
    """The objects, as `canopen`'s parameter server asks for them.

    Args:
        values: what they hold at first.
        read: asked before each reading; None = what is stored.
        written: told of each write, after it.
    """

    def __init__(
        self, values: dict[Entry, int], read: Callable[[Entry], int | None], written: Callable[[Entry, int], None]
    ) -> None:
        self.object_dictionary = ObjectDictionary()  # type: ignore[no-untyped-call]  # canopen annotates no constructor
        self.values = values
        self._read, self._written = read, written
        self._places = {(entry.index, entry.sub): entry for entry in values}

    def get_data(self, index: int, subindex: int, check_readable: bool = False) -> bytes:
        """What a reader is told."""
        entry = self._entry(index, subindex)
        told = self._read(entry)
        return entry.encoded(self.values[entry] if told is None else told)

    def set_data(self, index: int, subindex: int, data: bytes, check_writable: bool = False) -> None:
        """What a writer gives."""
        entry = self._entry(index, subindex)
        if entry in _READ_ONLY_OBJECTS:
            raise SdoAbortedError(_READ_ONLY)
        if len(data) != struct.calcsize(entry.kind):
            raise SdoAbortedError(_WRONG_LENGTH)
        self.values[entry] = entry.decoded(data)
        self._written(entry, self.values[entry])

    def _entry(self, index: int, subindex: int) -> Entry:
        if (index, subindex) not in self._places:
            raise SdoAbortedError(_NO_OBJECT)
        return self._places[index, subindex]
