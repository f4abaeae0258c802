"""Reads an exoskeleton file (TOML); what could not be moved safely is refused with file, key and expectation."""

from __future__ import annotations

from collections.abc import Callable
from math import isfinite
from pathlib import Path
from urllib.parse import urlsplit

import msgspec

from fusion.errors import InputError
from server.exoskeleton import FAMILIES, Exoskeleton, ExoskeletonJoint, Follows, StopCategory, device_limits
from server.typed_file import nearest, read_content, typed

NEEDED = (Follows.PLANE, Follows.ELEVATION, Follows.ELBOW)
SEE = "docs/exoskeletons.md"
HUMAN_RAD = {"plane": (-1.0, 2.5), "elevation": (-0.2, 3.1), "rotation": (-2.0, 2.0), "elbow": (-0.2, 2.8)}
"""Wider than any arm's; a device with more than half of its range outside has a wrong sign or offset."""


def read_exoskeleton(path: Path) -> Exoskeleton:
    """Read an exoskeleton file.

    Raises:
        InputError: the file cannot be read, or a key or value in it cannot be used; names file and key.
    """
    exoskeleton = typed(read_content(path, "exoskeleton file", SEE), Exoskeleton, path)
    drive = exoskeleton.drive
    if drive not in FAMILIES:
        raise InputError(
            f"'{path}': the value of 'drive' cannot be used: {drive}",
            f"one of {', '.join(FAMILIES)}",
            nearest(drive, FAMILIES),
        )
    check(exoskeleton, path)
    return exoskeleton


def check(exoskeleton: Exoskeleton, path: Path) -> None:
    """Refuse an exoskeleton that could not be moved safely.

    Raises:
        InputError: names file, key and what was expected.
    """
    file = f"'{path}'"
    for index, joint in enumerate(exoskeleton.joints):
        _check_joint(joint, f"{file}: joints[{index}]", f" ('{joint.name}')")
    _check_names(exoskeleton, file)
    _check_followers(exoskeleton, file)
    _check_movement(exoskeleton, file)
    if exoskeleton.drive in _FAMILIES:
        _FAMILIES[exoskeleton.drive](exoskeleton, file)


def _check_joint(joint: ExoskeletonJoint, where: str, who: str) -> None:
    if not joint.name.strip() or not joint.name.isprintable():
        raise InputError(f"{where}.name is empty or cannot be shown", "a name")
    for key, value in msgspec.structs.asdict(joint).items():
        if isinstance(value, float) and not isfinite(value):
            raise InputError(f"{where}.{key} is {value}{who}", "a finite number")
    if joint.min_rad >= joint.max_rad:
        crossed = f"{joint.min_rad:g} and {joint.max_rad:g}"
        raise InputError(f"{where}.min_rad is not below max_rad{who}: {crossed}", "min_rad < max_rad")
    if joint.follows is Follows.NONE and not joint.min_rad <= joint.rest_rad <= joint.max_rad:
        raise InputError(
            f"{where}.rest_rad lies outside the joint's range{who}: {joint.rest_rad:g}",
            f"{joint.min_rad:g} to {joint.max_rad:g}",
        )


def _check_names(exoskeleton: Exoskeleton, file: str) -> None:
    names = [joint.name for joint in exoskeleton.joints]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise InputError(f"{file}: two of 'joints' are called '{twice[0]}'", "a name of its own for each joint")


def _check_followers(exoskeleton: Exoskeleton, file: str) -> None:
    followed = [joint.follows for joint in exoskeleton.joints]
    for angle in NEEDED:
        if followed.count(angle) != 1:
            raise InputError(
                f"{file}: {followed.count(angle)} of 'joints' have follows = \"{angle}\"", "one joint for each angle"
            )
    turns = followed.count(Follows.ROTATION) + followed.count(Follows.AXIAL_ROTATION)
    if turns != 1:
        raise InputError(
            f'{file}: {turns} of \'joints\' have follows = "rotation" or "axial_rotation"',
            "one joint for one of the two",
        )


def _check_movement(exoskeleton: Exoskeleton, file: str) -> None:
    for limits in device_limits(exoskeleton):
        if min(limits.velocity_rad_s, limits.acceleration_rad_s2, limits.max_rad - limits.min_rad) <= 0:
            raise InputError(
                f"{file}: the joints leave no movement for the {limits.joint}",
                "an axial_rotation with a range, a velocity and an acceleration greater than the plane's own",
            )
        low, high = HUMAN_RAD[limits.joint]
        if min(limits.max_rad, high) - max(limits.min_rad, low) < (limits.max_rad - limits.min_rad) / 2:
            raise InputError(
                f"{file}: what the joint allows the {limits.joint}, {limits.min_rad:.2f} to {limits.max_rad:.2f} rad, "
                "is mostly nothing that an arm can do",
                f"at least half of it within {low:g} to {high:g} rad",
                f"mend sign, offset_rad, min_rad or max_rad of the joint that follows the {limits.joint}",
            )


def _check_cia402(exoskeleton: Exoskeleton, file: str) -> None:
    settings = exoskeleton.cia402
    for key in ("interface", "channel"):
        if not getattr(settings, key):
            raise InputError(
                f"{file}: the key 'cia402.{key}' is missing",
                f"{key} of the bus as python-can names it",
                'under [cia402]: interface = "socketcan", channel = "can0"',
            )
    for key, value in msgspec.structs.asdict(settings).items():
        if isinstance(value, float) and not isfinite(value):
            raise InputError(f"{file}: cia402.{key} is {value}", "a finite number")
    _check_nodes(exoskeleton, file)
    _check_carried(exoskeleton, file)


def _check_nodes(exoskeleton: Exoskeleton, file: str) -> None:
    taken = {exoskeleton.cia402.own_node: "the station (cia402.own_node)"}
    for index, joint in enumerate(exoskeleton.joints):
        where = f"{file}: joints[{index}].node"
        if not joint.node:
            raise InputError(f"{where} is missing ('{joint.name}')", "the number of its drive on the bus, 1 to 127")
        if joint.node in taken:
            raise InputError(
                f"{where} is {joint.node} ('{joint.name}'), which {taken[joint.node]} has already",
                "a node of its own for each joint",
            )
        taken[joint.node] = f"'{joint.name}'"


def _check_carried(exoskeleton: Exoskeleton, file: str) -> None:
    names = [joint.name for joint in exoskeleton.joints]
    for name, torque in exoskeleton.cia402.carry_nm.items():
        if name not in names:
            raise InputError(
                f"{file}: cia402.carry_nm: no joint is called '{name}'",
                f"some of {', '.join(names)}",
                nearest(name, names),
            )
        if not (isfinite(torque) and torque >= 0):
            raise InputError(f"{file}: cia402.carry_nm.{name} is {torque}", "a torque of 0 N m or more")


def _check_rosbridge(exoskeleton: Exoskeleton, file: str) -> None:
    settings = exoskeleton.rosbridge
    if not _is_websocket(settings.url):
        said = "is missing" if not settings.url else f"cannot be used: '{settings.url}'"
        raise InputError(f"{file}: the key 'rosbridge.url' {said}", 'such as "ws://127.0.0.1:9090"')
    for index, joint in enumerate(exoskeleton.joints):
        if joint.stop is StopCategory.COMPLIANT:
            raise InputError(
                f"{file}: joints[{index}].stop is '{joint.stop}' ('{joint.name}'), which rosbridge cannot do", "hold"
            )
    for key in ("trajectory_topic", "state_topic"):
        if not getattr(settings, key).startswith("/"):
            raise InputError(
                f"{file}: rosbridge.{key} is '{getattr(settings, key)}'", 'a topic, such as "/joint_states"'
            )


def _is_websocket(url: str) -> bool:
    try:
        parts = urlsplit(url)
        return parts.scheme in ("ws", "wss") and bool(parts.hostname) and parts.port != 0
    except ValueError:
        return False


_FAMILIES: dict[str, Callable[[Exoskeleton, str], None]] = {"cia402": _check_cia402, "rosbridge": _check_rosbridge}
"""What else a drive family needs."""
