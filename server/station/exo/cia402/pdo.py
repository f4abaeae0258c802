"""The process data that travel in each cycle, one message out and two in per joint, and how a node is told of them."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from server.station.exo.cia402 import objects
from server.station.exo.cia402.objects import Entry

WITH_SYNC = 1
"""Transmission type: taken over, and sent, at each SYNC."""
_OFF = 1 << 31
"""Bit of a PDO's identifier: not in use."""


@dataclass(frozen=True, slots=True)
class Pdo:
    """One process-data message."""

    first_id: int
    """Its identifier is this plus the node's number."""
    communication: int
    mapping: int
    """Indices of its two parameter objects."""
    entries: tuple[Entry, ...]

    @property
    def form(self) -> struct.Struct:
        """Its bytes."""
        return struct.Struct("<" + "".join(entry.kind for entry in self.entries))

    def settings(self, node: int) -> Iterator[tuple[Entry, int]]:
        """What to write, in the order that CiA 301 asks for: off, unmapped, mapped, on."""
        identifier = Entry(self.communication, 1, "I", "PDO's identifier")
        kind = Entry(self.communication, 2, "B", "PDO's transmission type")
        count = Entry(self.mapping, 0, "B", "number of mapped objects")
        yield identifier, _OFF | self.first_id + node
        yield kind, WITH_SYNC
        yield count, 0
        for place, entry in enumerate(self.entries, start=1):
            yield Entry(self.mapping, place, "I", f"mapped object {place}"), entry.mapping
        yield count, len(self.entries)
        yield identifier, self.first_id + node


SET_POINT: Final = Pdo(0x200, 0x1400, 0x1600, (objects.CONTROLWORD, objects.TARGET_POSITION, objects.MAX_TORQUE))
MEASURED: Final = Pdo(0x180, 0x1800, 0x1A00, (objects.STATUSWORD, objects.POSITION, objects.TORQUE))
DETAILS: Final = Pdo(0x280, 0x1801, 0x1A01, (objects.VELOCITY, objects.MODE_SHOWN, objects.ERROR_CODE))
PDOS: Final = (SET_POINT, MEASURED, DETAILS)

SYNC_ID, EMERGENCY_ID, HEARTBEAT_ID = 0x80, 0x80, 0x700
"""SYNC itself; emergency messages and heartbeats add the node's number."""
FRAME_BITS = 135
"""The longest frame of eight bytes, every stuff bit set."""


def load(nodes: int, period_s: float, bitrate: int) -> float:
    """Share of the bus that a cycle's messages take at worst, 0..1 and beyond."""
    return (len(PDOS) * nodes + 1) * FRAME_BITS / period_s / bitrate
