"""A drive's error codes in plain words (object 603Fh and emergency messages; CiA 301 table 26, CiA 402-2)."""

from __future__ import annotations

from typing import Final

HEARTBEAT_LOST = 0x8130
FOLLOWING_ERROR = 0x8611

_WORDS: Final[dict[int, str]] = {
    0x2310: "too much current for too long",
    0x2320: "a short circuit at the motor",
    0x2340: "a short circuit in the motor",
    0x3110: "the mains voltage is too high",
    0x3120: "the mains voltage is too low",
    0x3210: "its supply voltage is too high (a braking motor feeds back)",
    0x3220: "its supply voltage is too low",
    0x4210: "the drive is too hot",
    0x4310: "the motor is too hot",
    0x5441: "its enable input is open (safe torque off, emergency stop)",
    0x6320: "its settings contradict one another",
    0x7121: "the motor is blocked",
    0x7122: "the motor's commutation is lost",
    0x7305: "the encoder fails",
    0x7306: "the second encoder fails",
    0x7320: "its position cannot be trusted",
    0x7380: "the position sensor fails",
    0x8110: "it could not keep up with the bus",
    0x8120: "it finds too many errors on the bus",
    HEARTBEAT_LOST: "it heard nothing from the station and stopped by itself",
    0x8140: "it had left the bus",
    0x8210: "a set-point message was too short",
    0x8400: "it moved at another speed than commanded",
    FOLLOWING_ERROR: "it is too far from its set-point (something blocks it, or the load is too heavy)",
    0x8612: "its set-point lies outside its limits",
    0x8700: "the set-points' clock (SYNC) was lost",
}
_CLASSES: Final[dict[int, str]] = {
    0x1: "an error that its maker does not explain",
    0x2: "a current error",
    0x3: "a voltage error",
    0x4: "a temperature error",
    0x5: "an error of its electronics",
    0x6: "an error of its program",
    0x7: "an error of motor, brake or encoder",
    0x8: "an error of communication or supervision",
    0x9: "an error from outside",
    0xF: "an error of its maker's own",
}


def words(code: int) -> str:
    """What an error code means, with the code itself for the maker's manual."""
    return f"{_WORDS.get(code) or _CLASSES.get(code >> 12, 'an unknown error')} (error {code:04X}h)"
