"""Asks, moves one joint a little, asks what was seen, and says what the exoskeleton file should say."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import degrees, isfinite, radians
from typing import Final

from server.cli.exoskeleton_mover import Mover
from server.exoskeleton import Exoskeleton, ExoskeletonJoint, Follows

Ask = Callable[[str], str]
Say = Callable[[str], None]

MARGIN_RAD: Final = 0.02
"""So far from its ends no joint is moved."""
NOTABLE_RAD: Final = 0.005
"""An offset that differs by less is right."""
FOLLOWED: Final = 0.2
"""A joint that misses its way by more than this share does not follow."""


@dataclass(frozen=True, slots=True)
class Seen:
    """How an angle looks to who stands beside it (docs/angles.md)."""

    name: str
    zero: str
    more: str
    less: str


LOOKS: Final[dict[Follows, Seen]] = {
    Follows.PLANE: Seen("plane of elevation", "arm to the side", "go forwards", "go backwards"),
    Follows.ELEVATION: Seen("elevation", "arm hangs", "go up", "go down"),
    Follows.ROTATION: Seen("rotation of the upper arm", "bent forearm points ahead", "turn inwards", "turn outwards"),
    Follows.AXIAL_ROTATION: Seen(
        "axial rotation of the upper arm",
        "bent forearm points ahead of an arm to the side",
        "turn inwards",
        "turn outwards",
    ),
    Follows.ELBOW: Seen("elbow flexion", "straight", "bend", "straighten"),
}


@dataclass(frozen=True, slots=True)
class Dialogue:
    """How the wizard speaks: answers to questions, and sentences."""

    ask: Ask
    say: Say

    def agrees(self, question: str) -> bool:
        """Whether the answer is yes; anything else, and nothing, is no."""
        return self.ask(f"{question} [y/N] ").strip().lower() in ("y", "yes")


def walk(exoskeleton: Exoskeleton, mover: Mover, by_rad: float, person: Dialogue) -> dict[int, dict[str, float]]:
    """Go through the joints.

    Args:
        exoskeleton: as the file has it.
        mover: holds the device.
        by_rad: how far each joint is moved.
        person: who watches.

    Returns:
        Joint's index → key → what it should be, for what is wrong.

    Raises:
        MachineError: the drive reports a fault.
    """
    found = {i: _visit(i, joint, mover, by_rad, person) for i, joint in enumerate(exoskeleton.joints)}
    return {i: changes for i, changes in found.items() if changes}


def corrected(joint: ExoskeletonJoint, at_rad: float, reversed_: bool, truly_rad: float | None) -> dict[str, float]:
    """What the file should say of a joint.

    Args:
        joint: as the file has it.
        at_rad: where it is now, as it counts.
        reversed_: whether it went the other way than its sign says.
        truly_rad: the anatomical angle there; None = the file's is right.
    """
    sign = -joint.sign if reversed_ else joint.sign
    truly = joint.sign * (at_rad - joint.offset_rad) if truly_rad is None else truly_rad
    offset = round(at_rad - sign * truly, 3)
    changes: dict[str, float] = {"sign": sign} if reversed_ else {}
    return changes | ({"offset_rad": offset} if abs(offset - joint.offset_rad) > NOTABLE_RAD else {})


def _visit(index: int, joint: ExoskeletonJoint, mover: Mover, by_rad: float, person: Dialogue) -> dict[str, float]:
    if joint.follows is Follows.NONE:
        person.say(f"'{joint.name}' follows nothing; it is held and not moved.")
        return {}
    by_rad = _with_room(joint, mover.joint_rad(index), by_rad)
    if not by_rad:
        person.say(f"'{joint.name}' has no room for such a movement; it is held and not moved.")
        return {}
    looks, here = LOOKS[joint.follows], degrees(_anatomical(joint, mover.joint_rad(index)))
    way = looks.more if by_rad > 0 else looks.less
    where = f"{looks.name}, now {here:.1f}°; 0° = {looks.zero}"
    if not person.agrees(
        f"Move '{joint.name}' ({where}) slowly by {degrees(by_rad):+.0f}°, so that the arm will {way}?"
    ):
        person.say("It is held.")
        return {}
    _move(index, joint, mover, by_rad, person)
    changes = _judged(index, joint, mover, way, person)
    if person.agrees(f"Move '{joint.name}' back?"):
        mover.move(index, -joint.sign * by_rad)
    return changes


def _with_room(joint: ExoskeletonJoint, at_rad: float, by_rad: float) -> float:
    """The movement, the other way where there is no room; 0 where there is none at all."""
    for by in (by_rad, -by_rad):
        if joint.min_rad + MARGIN_RAD <= at_rad + joint.sign * by <= joint.max_rad - MARGIN_RAD:
            return by
    return 0.0


def _anatomical(joint: ExoskeletonJoint, at_rad: float) -> float:
    return joint.sign * (at_rad - joint.offset_rad)


def _move(index: int, joint: ExoskeletonJoint, mover: Mover, by_rad: float, person: Dialogue) -> None:
    before = mover.joint_rad(index)
    mover.move(index, joint.sign * by_rad)
    moved = joint.sign * (mover.joint_rad(index) - before)
    missed = "" if abs(moved - by_rad) <= FOLLOWED * abs(by_rad) else " It does not follow as it should."
    person.say(f"Measured {degrees(moved):+.1f}°, expected {degrees(by_rad):+.1f}°.{missed}")


def _judged(index: int, joint: ExoskeletonJoint, mover: Mover, way: str, person: Dialogue) -> dict[str, float]:
    """What a person saw."""
    seen = person.ask(f"Did the arm {way}? [y = yes, n = the other way, anything else = not sure] ").strip().lower()
    if seen not in ("y", "yes", "n", "no"):
        person.say(f"Nothing is concluded of '{joint.name}'.")
        return {}
    at_rad = mover.joint_rad(index)
    here = degrees(_anatomical(joint, at_rad))
    name = LOOKS[joint.follows].name
    measured = person.ask(f"What is the {name} now, by a goniometer, in degrees? [Enter = the file's {here:.1f}] ")
    truly = _number(measured)
    if truly is None and measured.strip():
        person.say("That is no angle; the file's is kept.")
    return corrected(joint, at_rad, seen.startswith("n"), None if truly is None else radians(truly))


def _number(text: str) -> float | None:
    try:
        value = float(text.strip().removesuffix("°").replace(",", "."))
    except ValueError:
        return None
    return value if isfinite(value) and abs(value) <= 360 else None
