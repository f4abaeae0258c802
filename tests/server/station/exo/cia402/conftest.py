"""Emulated drives for the tests of this folder."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from cia402_bench import Bench, emulated, four_joints  # found by the line above


@pytest.fixture
def bench() -> Iterator[Bench]:
    """Four drives, running."""
    with emulated(four_joints()) as running:
        yield running
