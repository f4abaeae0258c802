"""What a link or a peer that is closed in the middle of joining leaves behind is swept up after each test."""

from __future__ import annotations

import gc
import sys
import warnings
from collections.abc import Iterator

import pytest


@pytest.fixture(autouse=True)
def swept(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """A loop that ends while somebody joins leaves that socket to the collector, which warns in some later test."""
    yield
    with warnings.catch_warnings(), monkeypatch.context() as patch:
        warnings.simplefilter("ignore", ResourceWarning)
        patch.setattr(sys, "unraisablehook", lambda _: None)
        gc.collect()
