"""Orders to running emulated drives, one a line, and a journal of how their joints truly moved."""

from __future__ import annotations

import logging
import socket
from collections.abc import Callable, Mapping
from pathlib import Path
from types import TracebackType
from typing import Final, Self

from server.emulated.cia402.node import Disturbance, EmulatedNode

log = logging.getLogger(__name__)

EVERY_S = 0.005
ORDERS: Final[dict[str, Callable[[EmulatedNode, float], None]]] = {
    "fault": lambda node, code: node.drive.fail(int(code)),
    "silent": lambda node, on: setattr(node.wrong, "silent", bool(on)),
    "no-heartbeat": lambda node, on: setattr(node.wrong, "no_heartbeat", bool(on)),
    "no-measurement": lambda node, on: setattr(node.wrong, "no_measurement", bool(on)),
    "lie": lambda node, rad: setattr(node.wrong, "lie_rad", rad),
    "lag": lambda node, seconds: setattr(node.wrong, "lag_s", seconds),
    "false-limits": lambda node, on: setattr(node.wrong, "false_limits", bool(on)),
    "refuse-limits": lambda node, on: setattr(node.wrong, "refuse_limits", bool(on)),
    "blocked": lambda node, on: setattr(node.drive.motor, "blocked", bool(on)),
    "load": lambda node, nm: setattr(node.drive.motor, "load_nm", nm),
    "place": lambda node, rad: node.place(rad),
    "restart": lambda node, _: node.restart(),
    "forget": lambda node, _: node.drive.forget(),
    "well": lambda node, _: setattr(node, "wrong", Disturbance()),
}
"""Each takes one number, 1 where none is given: "fault JOINT CODE", "lie JOINT RAD", "silent JOINT", "well JOINT"."""


def obey(line: str, nodes: Mapping[str, EmulatedNode]) -> str:
    """Do what a line asks: ORDER JOINT [NUMBER], JOINT may be "all"; numbers may be hexadecimal (0x7121).

    Returns:
        Why it could not be done; "" = done.
    """
    order, _, rest = line.strip().partition(" ")
    joint, _, number = rest.rpartition(" ") if _is_number(rest.rpartition(" ")[2]) else (rest, "", "1")
    if order not in ORDERS or (joint != "all" and joint not in nodes):
        return f"'{line}' is no order: one of {', '.join(ORDERS)}, then one of all, {', '.join(nodes)}"
    for node in nodes.values() if joint == "all" else (nodes[joint],):
        ORDERS[order](node, _number(number))
    return ""


def _is_number(text: str) -> bool:
    try:
        _number(text)
    except ValueError:
        return False
    return True


def _number(text: str) -> float:
    return int(text, 16) if text.lower().startswith("0x") else float(text)


class Control:
    """Takes orders from a Unix datagram socket.

    Args:
        path: where it is; removed at the end.
    """

    def __init__(self, path: Path) -> None:
        self._path = path

    def __enter__(self) -> Self:
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self._socket.setblocking(False)
        self._socket.bind(str(self._path))
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._socket.close()
        self._path.unlink(missing_ok=True)

    def obey_all(self, nodes: Mapping[str, EmulatedNode]) -> None:
        """Do what has been asked since the last call."""
        while True:
            try:
                line = self._socket.recv(1024).decode(errors="replace")
            except BlockingIOError:
                return
            refused = obey(line, nodes)
            if refused:
                log.error("%s", refused)


def order(path: Path, line: str) -> None:
    """Send an order to emulated drives that run in another process."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as sender:
        sender.sendto(line.encode(), str(path))


class Journal:
    """Writes t_s (monotonic, the same clock in every process of a machine), joint, angle, speed and state as CSV.

    Args:
        path: the file.
    """

    def __init__(self, path: Path) -> None:
        self._path, self._noted_s = path, float("-inf")

    def __enter__(self) -> Self:
        self._file = self._path.open("w", buffering=1, encoding="utf-8")
        self._file.write("t_s,joint,angle_rad,velocity_rad_s,state\n")
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._file.close()

    def note(self, nodes: Mapping[str, EmulatedNode], now_s: float) -> None:
        """A line per joint, no more often than every 5 ms."""
        if now_s - self._noted_s < EVERY_S:
            return
        self._noted_s = now_s
        self._file.write("".join(_line(name, node, now_s) for name, node in nodes.items()))


def _line(name: str, node: EmulatedNode, now_s: float) -> str:
    motor = node.drive.motor
    return f"{now_s:.4f},{name},{motor.angle_rad:.5f},{motor.velocity_rad_s:.4f},{node.drive.state.value}\n"
