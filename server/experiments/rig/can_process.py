"""`python -m server.experiments.rig.can_process`: emulated CiA 402 drives on a CAN bus between processes."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from pathlib import Path

import msgspec

from server.emulated.cia402.serve import open_bus, serve
from server.exoskeleton import Exoskeleton
from server.station import pacemaker


def main(arguments: Sequence[str] | None = None) -> int:
    """Emulate until the process that started it has gone."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--exoskeleton", type=Path, required=True, help="JSON")
    parser.add_argument("--control", type=Path, required=True, help="datagram socket that takes orders")
    parser.add_argument("--journal", type=Path, required=True, help="file to write")
    options = parser.parse_args(arguments)
    exoskeleton = msgspec.json.decode(options.exoskeleton.read_bytes(), type=Exoskeleton)
    parent = os.getppid()
    with open_bus(exoskeleton.cia402) as bus:
        pacemaker.settle()
        pacemaker.ask_for_priority()  # real drives are not held up by what the computer does
        serve(exoskeleton, bus, lambda: os.getppid() == parent, options.control, options.journal)
    return 0


if __name__ == "__main__":
    sys.exit(main())
