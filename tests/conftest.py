"""Fixtures that every test may use."""

from __future__ import annotations

import os
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
