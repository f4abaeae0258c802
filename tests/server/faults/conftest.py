"""Scenes that the fault tests share: real processes, started once for many faults."""

from __future__ import annotations

from collections.abc import AsyncIterator, Awaitable, Callable

import pytest
import pytest_asyncio

from server.experiments.rig.faults import FAULTS
from server.experiments.rig.observing import Observed, observed
from server.experiments.rig.scene import Scene, scene

ATTEMPTS = 5
"""On a machine that is busy with other things a real loop stands still now and then, and holds, as it must (SR-3)."""
Shown = Callable[[Scene, str], Awaitable[Observed]]


@pytest_asyncio.fixture(scope="module", loop_scope="module")
async def a_scene(tmp_path_factory: pytest.TempPathFactory) -> AsyncIterator[Scene]:
    async with scene(tmp_path_factory.mktemp("scene")) as opened:
        yield opened


@pytest.fixture(scope="session")
def shown() -> Shown:
    """Put a fault in and see that what becomes of the arm is safe, in its time."""

    async def show(where: Scene, name: str) -> Observed:
        fault = next(fault for fault in FAULTS if fault.name == name)
        troubles = []
        for _ in range(1 if fault.ends_station else ATTEMPTS):
            found = await observed(where, fault)
            if not found.trouble:
                return found
            troubles.append(found.trouble)
        pytest.fail(f"{fault.what}: " + " | ".join(troubles))

    return show
