"""A station's ticks without the rest of it, to be killed: moves every joint at 0.3 rad/s until it dies.

Run as `python moving_station.py FILE`; says "ticking" when the drives are open.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

from server.exoskeleton_file import read_exoskeleton
from server.station.exo.cia402 import Cia402Drive
from server.station.exo.driver import ZERO, DriveCommand, DriveMode

RAD_S = 0.3


def main() -> None:
    """Tick at 100 Hz."""
    with Cia402Drive(read_exoskeleton(Path(sys.argv[1]))) as drive:
        start, begun_s = drive.read(time.monotonic()).angle_rad, time.monotonic()
        sys.stdout.write("ticking\n")
        sys.stdout.flush()
        while True:
            now_s = time.monotonic()
            drive.read(now_s)
            moved = tuple(angle + max(now_s - begun_s - 0.5, 0.0) * RAD_S for angle in start)
            drive.command(DriveCommand(DriveMode.FOLLOW, moved, ZERO, ""), now_s)
            time.sleep(0.01)


if __name__ == "__main__":
    main()
