"""Lets CiA 402 drives that do not know where they stand find their home, joint by joint, each after a yes."""

from __future__ import annotations

from fusion.errors import InputError
from server.cli.exoskeleton_wizard import Dialogue
from server.exoskeleton import Exoskeleton


def walk_home(device: Exoskeleton, person: Dialogue) -> None:
    """Ask for each joint that is not homed, and home it.

    Raises:
        InputError: the device is not on a CANopen bus.
        MachineError: a drive does not answer, or did not find its home.
    """
    if device.drive != "cia402":
        raise InputError(f"drive is '{device.drive}', which has no homing of its own", 'drive = "cia402"')
    # python-can is an optional extra; the other commands work without it.
    from server.station.exo.cia402.homing import home, is_homed

    for joint in device.joints:
        if is_homed(device, joint.name):
            person.say(f"{joint.name}: knows where it stands.")
        elif person.agrees(_question(device, joint.name)):
            home(device, joint.name)
            person.say(f"{joint.name}: homed, and holds.")
        else:
            person.say(f"{joint.name}: left as it was; the station will not start with it.")


def _question(device: Exoskeleton, name: str) -> str:
    method = device.cia402.homing_method
    if method in (35, 37):
        return f"{name}: is it exactly at its zero now? It is taken for 0 without moving (method {method})."
    return f"{name}: may it move through its whole range to find its home (method {method})?"
