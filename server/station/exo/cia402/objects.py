"""The objects of a CiA 402 drive that are used here: index, subindex, type and name (CiA 301, CiA 402-2)."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import Literal

Kind = Literal["b", "B", "h", "H", "i", "I"]
"""As in `struct`: signed and unsigned integers of 8, 16 and 32 bits."""


@dataclass(frozen=True, slots=True)
class Entry:
    """One value in a node's object dictionary."""

    index: int
    sub: int
    kind: Kind
    name: str

    def __str__(self) -> str:
        return f"{self.index:04X}h:{self.sub:02X} ({self.name})"

    @property
    def bits(self) -> int:
        """Length on the bus."""
        return 8 * struct.calcsize(self.kind)

    def encoded(self, value: int) -> bytes:
        """The value as it travels.

        Raises:
            struct.error: it does not fit.
        """
        return struct.pack(f"<{self.kind}", value)

    def decoded(self, data: bytes) -> int:
        """What travelled; some devices send four bytes for a shorter value."""
        value: int = struct.unpack_from(f"<{self.kind}", data)[0]
        return value

    @property
    def mapping(self) -> int:
        """The entry as a PDO mapping names it."""
        return self.index << 16 | self.sub << 8 | self.bits


DEVICE_TYPE = Entry(0x1000, 0, "I", "device type")
ERROR_REGISTER = Entry(0x1001, 0, "B", "error register")
LAST_ERROR = Entry(0x1003, 1, "I", "newest error")
CONSUMER_HEARTBEAT = Entry(0x1016, 1, "I", "consumer heartbeat time")
PRODUCER_HEARTBEAT = Entry(0x1017, 0, "H", "producer heartbeat time")
VENDOR = Entry(0x1018, 1, "I", "vendor")

ABORT_OPTION = Entry(0x6007, 0, "h", "abort connection option code")
ERROR_CODE = Entry(0x603F, 0, "H", "error code")
CONTROLWORD = Entry(0x6040, 0, "H", "controlword")
STATUSWORD = Entry(0x6041, 0, "H", "statusword")
QUICK_STOP_OPTION = Entry(0x605A, 0, "h", "quick stop option code")
FAULT_REACTION_OPTION = Entry(0x605E, 0, "h", "fault reaction option code")
MODE = Entry(0x6060, 0, "b", "mode of operation")
MODE_SHOWN = Entry(0x6061, 0, "b", "mode of operation display")
POSITION = Entry(0x6064, 0, "i", "position actual value")
VELOCITY = Entry(0x606C, 0, "i", "velocity actual value")
MAX_TORQUE = Entry(0x6072, 0, "H", "max torque")
MAX_CURRENT = Entry(0x6073, 0, "H", "max current")
RATED_TORQUE = Entry(0x6076, 0, "I", "motor rated torque")
TORQUE = Entry(0x6077, 0, "h", "torque actual value")
TARGET_POSITION = Entry(0x607A, 0, "i", "target position")
MIN_POSITION = Entry(0x607D, 1, "i", "software position limit, minimum")
MAX_POSITION = Entry(0x607D, 2, "i", "software position limit, maximum")
POLARITY = Entry(0x607E, 0, "B", "polarity")
MAX_PROFILE_VELOCITY = Entry(0x607F, 0, "I", "max profile velocity")
MAX_MOTOR_SPEED = Entry(0x6080, 0, "I", "max motor speed")
QUICK_STOP_DECELERATION = Entry(0x6085, 0, "I", "quick stop deceleration")
ENCODER_COUNTS = Entry(0x608F, 1, "I", "encoder increments")
ENCODER_TURNS = Entry(0x608F, 2, "I", "motor revolutions")
HOMING_METHOD = Entry(0x6098, 0, "b", "homing method")
INTERPOLATION_TIME = Entry(0x60C2, 1, "B", "interpolation time period")
INTERPOLATION_EXPONENT = Entry(0x60C2, 2, "b", "interpolation time index")
MAX_ACCELERATION = Entry(0x60C5, 0, "I", "max acceleration")
SUPPORTED_MODES = Entry(0x6502, 0, "I", "supported drive modes")

CYCLIC_POSITION, HOMING = 8, 6
"""Values of `MODE`."""
MODE_BITS = {CYCLIC_POSITION: 1 << 7, HOMING: 1 << 5}
"""Their bits in `SUPPORTED_MODES`."""
PROFILE_402 = 402
"""The low half of `DEVICE_TYPE`."""
