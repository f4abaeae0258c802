"""`python -m server.emulated.cia402 FILE`: emulated drives in a process of their own, until it is told to end.

`mirrorlimb emulate cia402` is the same for people; this one takes orders by a socket and keeps a journal.
"""

from __future__ import annotations

import argparse
import os
import signal
import sys
from pathlib import Path

from fusion.errors import MirrorlimbError
from server.emulated.cia402.serve import open_bus, serve
from server.exoskeleton_file import read_exoskeleton
from server.station.pacemaker import ask_for_priority

UNUSABLE = 2


def main() -> int:
    """Run until SIGTERM, SIGINT or the death of whoever started it; a line says when the bus is open.

    Returns:
        The exit code.
    """
    parser = argparse.ArgumentParser(prog="python -m server.emulated.cia402", description="Emulated CiA 402 drives.")
    parser.add_argument("file", type=Path, help="exoskeleton file")
    parser.add_argument("--control", type=Path, help="datagram socket that takes orders")
    parser.add_argument("--journal", type=Path, help="CSV file of the joints' true movement")
    options = parser.parse_args()
    ended, parent = [], os.getppid()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: ended.append(True))
    try:
        exoskeleton = read_exoskeleton(options.file)
        with open_bus(exoskeleton.cia402) as bus:
            ask_for_priority()  # real drives have processors of their own
            sys.stdout.write("listening\n")
            sys.stdout.flush()
            serve(exoskeleton, bus, lambda: not ended and os.getppid() == parent, options.control, options.journal)
    except MirrorlimbError as error:
        sys.stderr.write(f"{error}\n")
        return UNUSABLE
    return 0


if __name__ == "__main__":
    sys.exit(main())
