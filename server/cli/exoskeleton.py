"""`mirrorlimb exoskeleton`: looks at an exoskeleton file, and tries it on the device joint by joint."""

from __future__ import annotations

import sys
from math import degrees, radians
from pathlib import Path
from typing import Annotated

import typer
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table

from fusion.errors import InputError, MirrorlimbError
from server.cli.exoskeleton_edit import changed, edited, write
from server.cli.exoskeleton_home import walk_home
from server.cli.exoskeleton_mover import Mover
from server.cli.exoskeleton_wizard import Dialogue, walk
from server.exoskeleton import Exoskeleton, ExoskeletonJoint, Follows, device_limits
from server.exoskeleton_file import check as check_device
from server.exoskeleton_file import read_exoskeleton
from server.station.exo.drives import make_drive

exoskeleton = typer.Typer(
    name="exoskeleton",
    add_completion=False,
    pretty_exceptions_enable=False,
    no_args_is_help=True,
    help="Look at an exoskeleton file, and try it on the device.",
)

File = Annotated[Path, typer.Argument(metavar="FILE", help="An exoskeleton file (TOML).", show_default=False)]


@exoskeleton.command()
def check(file: File) -> None:
    """Read the file as the station would, and show what it says; nothing is opened and nothing moves."""
    device = read_exoskeleton(file)
    make_drive(device)  # what only the drive's family can tell: a bus that is too slow, an extra that is missing
    console = Console(highlight=False)
    console.print(f"{device.name}: {_reached(device)}", markup=False, soft_wrap=True)
    console.print(_joints(device))
    console.print("What this leaves to each angle of the arm, whatever the others are:")
    console.print(_angles(device))


@exoskeleton.command()
def wizard(
    file: File,
    by: Annotated[float, typer.Option(min=1.0, max=10.0, metavar="DEGREES", help="How far a joint is moved.")] = 5.0,
) -> None:
    """Move one joint at a time, slowly, each after a yes, and mend the file's signs and offsets by what you saw."""
    device = read_exoskeleton(file)
    if not sys.stdin.isatty():
        raise InputError("The wizard asks before every movement, and nobody can answer here", "a terminal")
    person = Dialogue(_ask, typer.echo)
    typer.echo(f"{device.name}: {_reached(device)}. Ctrl-C holds at once, at any time.")
    if not person.agrees("Is nobody's arm in it, and its emergency stop in your hand?"):
        typer.echo("Nothing was opened.")
        return
    with make_drive(device) as drive, Mover(drive, device) as mover:
        changes = walk(device, mover, radians(by), person)
    _mend(file, device, changes, person)


@exoskeleton.command()
def home(file: File) -> None:
    """Let CiA 402 drives that do not know where they stand find their home, joint by joint, each after a yes."""
    device = read_exoskeleton(file)
    if not sys.stdin.isatty():
        raise InputError("Homing asks before every movement, and nobody can answer here", "a terminal")
    person = Dialogue(_ask, typer.echo)
    if person.agrees("Is nobody's arm in it, and its emergency stop in your hand?"):
        walk_home(device, person)
    else:
        typer.echo("Nothing was opened.")


def _ask(question: str) -> str:
    """What is typed; an input that has ended is a no."""
    typer.echo(question, nl=False)
    return sys.stdin.readline()


def _mend(file: Path, device: Exoskeleton, changes: dict[int, dict[str, float]], person: Dialogue) -> None:
    """Offer to write what is wrong; what cannot be written is said."""
    if not changes:
        typer.echo(f"Nothing in '{file}' needs to be changed.")
        return
    for index, values in changes.items():
        for key, value in values.items():
            was = getattr(device.joints[index], key)
            typer.echo(f"joints[{index}] ('{device.joints[index].name}'): {key} = {value:g}, was {was:g}")
    try:
        check_device(changed(device, changes), file)
    except MirrorlimbError as error:
        typer.echo(f"Not written, for it could not be used: {error}")
        return
    text = edited(file.read_text("utf-8"), changes)
    if text is None:
        typer.echo("The file is written in a way in which this must be done by hand.")
    elif person.agrees(f"Write this into '{file}'?"):
        write(file, text)
        typer.echo("Written. Run the wizard again: it should find nothing.")
    else:
        typer.echo("The file is as it was.")


def _reached(device: Exoskeleton) -> str:
    if device.drive == "cia402":
        return f"CiA 402 drives on the CAN bus {device.cia402.interface} {device.cia402.channel}"
    if device.drive == "rosbridge":
        return f"ROS 2 through rosbridge at {device.rosbridge.url}"
    return "simulated"


def _joints(device: Exoskeleton) -> Table:
    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    for name in ("joint", "counts, rad"):
        table.add_column(name, overflow="fold")
    for name in ("its range °", "of the arm °", "°/s", "N m", "stop"):
        table.add_column(name, no_wrap=True)
    for joint in device.joints:
        table.add_row(*_row(joint))
    return table


def _row(joint: ExoskeletonJoint) -> tuple[str, ...]:
    moves = joint.follows is not Follows.NONE
    angle = sorted(joint.sign * (end - joint.offset_rad) for end in (joint.min_rad, joint.max_rad))
    offset = f" {joint.offset_rad:+g}" if joint.offset_rad else ""
    return (
        joint.name,
        f"{'-' if joint.sign < 0 else ''}{joint.follows}{offset}" if moves else f"held at {joint.rest_rad:g}",
        _range_deg(joint.min_rad, joint.max_rad),
        _range_deg(*angle) if moves else "",
        f"{degrees(joint.velocity_rad_s):.0f}",
        f"{joint.torque_nm:g}",
        joint.stop.value,
    )


def _angles(device: Exoskeleton) -> Table:
    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    for name in ("angle", "range °", "°/s", "°/s²"):
        table.add_column(name)
    for limits in device_limits(device):
        ends = _range_deg(limits.min_rad, limits.max_rad)
        speeds = (limits.velocity_rad_s, limits.acceleration_rad_s2)
        table.add_row(limits.joint, ends, *(f"{degrees(value):.0f}" for value in speeds))
    return table


def _range_deg(low_rad: float, high_rad: float) -> str:
    return f"{degrees(low_rad):.0f} … {degrees(high_rad):.0f}"
