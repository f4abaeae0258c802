"""`mirrorlimb emulate`: a device that is not there, for an engineer without hardware."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from enum import StrEnum
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import Annotated

import typer

from fusion.errors import InputError
from server.exoskeleton import Exoskeleton
from server.exoskeleton_file import read_exoskeleton
from server.station.exo.drives import require


class Emulated(StrEnum):
    """The drive families that have an emulated device."""

    CIA402 = "cia402"
    ROSBRIDGE = "rosbridge"


def emulate(
    family: Annotated[Emulated, typer.Argument(help="What is emulated.", show_default=False)],
    exoskeleton: Annotated[Path, typer.Option(metavar="FILE", help="The exoskeleton file.", show_default=False)],
) -> None:
    """Run the emulated device of an exoskeleton file until Ctrl-C; typed lines make it fail."""
    device = read_exoskeleton(exoskeleton)
    if device.drive != family:
        raise InputError(
            f"'{exoskeleton}': drive is '{device.drive}'", f"'{family}'", f"emulate {device.drive}, or another file"
        )
    require(family)
    typed: SimpleQueue[str] = SimpleQueue()
    threading.Thread(target=_listen, args=(typed,), daemon=True).start()
    with suppress(KeyboardInterrupt):
        (_cia402 if family is Emulated.CIA402 else _rosbridge)(device, typed)


def _cia402(device: Exoskeleton, typed: SimpleQueue[str]) -> None:
    # python-can is an optional extra; the other family works without it.
    from server.emulated.cia402.control import ORDERS, obey
    from server.emulated.cia402.serve import Emulator, open_bus

    with open_bus(device.cia402) as bus:
        emulator = Emulator(device, bus)
        place = f"{device.cia402.interface} {device.cia402.channel}"
        _say(device, place, f"ORDER JOINT [NUMBER] with an order of {', '.join(ORDERS)}; JOINT may be all")
        while True:
            emulator.cycle()
            _obey(typed, lambda line: obey(line, emulator.nodes), wait=False)


def _rosbridge(device: Exoskeleton, typed: SimpleQueue[str]) -> None:
    from server.emulated.rosbridge import COMMANDS, open_peer

    with open_peer(device) as peer:
        _say(device, peer.url, COMMANDS)
        while True:
            _obey(typed, peer.obey, wait=True)


def _say(device: Exoskeleton, place: str, orders: str) -> None:
    typer.echo(f"An emulated '{device.name}' listens at {place}. End it with Ctrl-C. To make it fail, type: {orders}.")


def _listen(typed: SimpleQueue[str]) -> None:
    for line in sys.stdin:
        typed.put(line.strip())


def _obey(typed: SimpleQueue[str], obey: Callable[[str], str], wait: bool) -> None:
    with suppress(Empty):
        line = typed.get(block=wait)
        if line:
            typer.echo(obey(line) or line)
