"""Reads an exoskeleton file (TOML); what could not be moved safely is refused with file, key and expectation."""

from __future__ import annotations

from math import isfinite
from pathlib import Path

from fusion.errors import InputError
from server.exoskeleton import Exoskeleton, ExoskeletonJoint, Follows, device_limits
from server.typed_file import read_content, typed

NEEDED = (Follows.PLANE, Follows.ELEVATION, Follows.ELBOW)
SEE = "docs/exoskeletons.md"


def read_exoskeleton(path: Path) -> Exoskeleton:
    """Read an exoskeleton file.

    Raises:
        InputError: the file cannot be read, or a key or value in it cannot be used; names file and key.
    """
    exoskeleton = typed(read_content(path, "exoskeleton file", SEE), Exoskeleton, path)
    check(exoskeleton, path)
    return exoskeleton


def check(exoskeleton: Exoskeleton, path: Path) -> None:
    """Refuse an exoskeleton that could not be moved safely.

    Raises:
        InputError: names file, key and what was expected.
    """
    for index, joint in enumerate(exoskeleton.joints):
        _check_joint(joint, f"'{path}': joints[{index}] ('{joint.name}')")
    _check_names(exoskeleton, path)
    _check_followers(exoskeleton, path)
    for limits in device_limits(exoskeleton):
        if limits.min_rad >= limits.max_rad or min(limits.velocity_rad_s, limits.acceleration_rad_s2) <= 0:
            raise InputError(
                f"'{path}': the joints leave no movement for the {limits.joint}",
                "an axial rotation with a range, speed and acceleration greater than the plane's own",
            )


def _check_joint(joint: ExoskeletonJoint, where: str) -> None:
    numbers = (
        joint.offset_rad,
        joint.rest_rad,
        joint.min_rad,
        joint.max_rad,
        joint.velocity_rad_s,
        joint.acceleration_rad_s2,
        joint.torque_nm,
        joint.gear_ratio,
    )
    if not all(map(isfinite, numbers)):
        raise InputError(f"{where}: not every value is a finite number", "finite numbers")
    if joint.min_rad >= joint.max_rad:
        raise InputError(f"{where}: min_rad is not below max_rad", "min_rad < max_rad")
    if joint.follows is Follows.NONE and not joint.min_rad <= joint.rest_rad <= joint.max_rad:
        raise InputError(f"{where}: rest_rad lies outside the joint's range", "min_rad <= rest_rad <= max_rad")


def _check_names(exoskeleton: Exoskeleton, path: Path) -> None:
    names = [joint.name for joint in exoskeleton.joints]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise InputError(f"'{path}': two joints are called '{twice[0]}'", "a name of its own for each joint")


def _check_followers(exoskeleton: Exoskeleton, path: Path) -> None:
    followed = [joint.follows for joint in exoskeleton.joints]
    for angle in NEEDED:
        if followed.count(angle) != 1:
            raise InputError(f"'{path}': {followed.count(angle)} joints follow the {angle}", "one joint for each angle")
    turns = followed.count(Follows.ROTATION) + followed.count(Follows.AXIAL_ROTATION)
    if turns != 1:
        raise InputError(
            f"'{path}': {turns} joints follow the rotation or the axial_rotation", "one joint for one of the two"
        )
