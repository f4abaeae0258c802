"""`python -m server.station --config FILE`: starts the station; errors are sentences on the error output."""

from __future__ import annotations

import argparse
import logging
import os
import sys
from collections.abc import Sequence
from pathlib import Path

from fusion.errors import MirrorlimbError
from server.config import read_start
from server.station.process import run

UNUSABLE, FAILED = 2, 1


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the station; 0 on an ordered end, 2 on what cannot be used, 1 on a fault of our own."""
    parser = argparse.ArgumentParser(prog="python -m server.station", description=__doc__)
    parser.add_argument("--config", type=Path, required=True, help="what the service wrote for the station")
    options = parser.parse_args(arguments)
    try:
        run(read_start(options.config))
    except MirrorlimbError as error:
        print(f"{error}", file=sys.stderr)
        return UNUSABLE
    except Exception as error:
        logging.getLogger(__name__).exception("the station failed")
        print(f"The station failed ({type(error).__name__}: {error}); see logs/realtime.log.", file=sys.stderr)
        return FAILED
    return 0


if __name__ == "__main__":
    ended = main()
    logging.shutdown()
    sys.stdout.flush()
    # At once: what libraries say while they are taken down (ruckig's binding does) must not follow our last words,
    # which the service tells people.
    sys.stderr.flush()
    os._exit(ended)
