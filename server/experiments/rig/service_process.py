"""`python -m server.experiments.rig.service_process`: the demonstration's service, its station's drive elsewhere."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from server.api.serve import run
from server.config import Config, SensorsConfig, StationConfig
from server.experiments.rig.loop_in_thread import start_loop
from server.experiments.rig.scene import COMMAND

FREE_PORTS = dict.fromkeys(SensorsConfig().ports, 0)


def main(arguments: Sequence[str] | None = None) -> int:
    """Serve on free ports until somebody ends it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--data", required=True, help="data folder")
    parser.add_argument("--loop-drive", default="", help="run the loop in a thread of this process too, on this drive")
    options = parser.parse_args(arguments)
    station = StationConfig(sensors=SensorsConfig(ports=FREE_PORTS))
    if options.loop_drive:
        sys.stdout.write(f"{start_loop(station, Path(options.data).parent, options.loop_drive)}\n")
    run(Config(port=0, data=options.data, demo=True, station=station), COMMAND)
    return 0


if __name__ == "__main__":
    sys.exit(main())
