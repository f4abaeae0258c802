"""Fixtures that every test may use."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from hypothesis import settings

# The same examples every time, and no deadlines: a busy machine is not a fault.
settings.register_profile("house", derandomize=True, deadline=None)
settings.load_profile("house")

RECORDINGS = os.environ.get("MIRRORLIMB_RECORDINGS", "")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out the tests on real recordings when their folder is not named; `pytest_report_header` says so."""
    if RECORDINGS:
        return
    left_out = [item for item in items if item.get_closest_marker("recordings")]
    if left_out:
        items[:] = [item for item in items if not item.get_closest_marker("recordings")]
        config.hook.pytest_deselected(items=left_out)


def pytest_report_header() -> str:
    """One line on the real recordings."""
    if RECORDINGS:
        return f"real recordings: {RECORDINGS}"
    return "real recordings: LEFT OUT. Set MIRRORLIMB_RECORDINGS to their folder to run those tests too (see README)."


@pytest.fixture(scope="session")
def recordings() -> Path:
    """The folder of real recordings; fails where it is named but missing."""
    folder = Path(RECORDINGS).resolve()
    if not folder.is_dir():
        pytest.fail(f"MIRRORLIMB_RECORDINGS names '{RECORDINGS}', which is no folder.")
    return folder


@dataclass(frozen=True)
class RunningService:
    """A real `mirrorlimb serve` in a process of its own."""

    address: str
    data: Path
    process: subprocess.Popen[str]


def _address_printed(process: subprocess.Popen[str]) -> str:
    lines = []
    for line in process.stdout:
        lines.append(line)
        found = re.search(r"http://\S+", line)
        if found:
            return found[0].rstrip("/")
    process.wait(timeout=10)
    pytest.fail(f"mirrorlimb serve ended with {process.returncode} and said:\n{''.join(lines)}")


@pytest.fixture
def start_service(tmp_path: Path) -> Iterator[Callable[..., RunningService]]:
    """Start `mirrorlimb serve` on free ports with a data folder of its own; ended when the test is over."""
    started: list[subprocess.Popen[str]] = []

    def start(*options: str) -> RunningService:
        config = tmp_path / "mirrorlimb.toml"
        config.write_text(
            "port = 0\n[station.sensors.ports]\n'kinectv2-osc' = 0\nosceleton2 = 0\nmirrorlimb = 0\n", "utf-8"
        )
        data = tmp_path / "data"
        command = [str(Path(sys.executable).with_name("mirrorlimb")), "serve", "--config", config, "--data", data]
        process = subprocess.Popen(
            [*command, *options], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, stdin=subprocess.DEVNULL
        )
        started.append(process)
        return RunningService(_address_printed(process), data, process)

    yield start
    for process in started:
        process.terminate()
    for process in started:
        process.wait(timeout=20)
        process.stdout.close()
