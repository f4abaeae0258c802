"""Scenes that the fault tests share: real processes, started once for many faults."""

from __future__ import annotations

from collections.abc import AsyncIterator, Awaitable, Callable

import pytest
import pytest_asyncio

from server.experiments.rig.can_scene import can_scene
from server.experiments.rig.fault import Fault, Where
from server.experiments.rig.live_service import LiveService, live_service
from server.experiments.rig.observing import Observed, observed, trouble
from server.experiments.rig.scene import Scene, scene

ATTEMPTS = 5
"""On a machine that is busy with other things a real loop stands still now and then, and holds, as it must (SR-3)."""
Shown = Callable[[Where, tuple[Fault[Where], ...], str], Awaitable[Observed]]


@pytest_asyncio.fixture(scope="module", loop_scope="module")
async def a_scene(tmp_path_factory: pytest.TempPathFactory) -> AsyncIterator[Scene]:
    async with scene(tmp_path_factory.mktemp("scene")) as opened:
        yield opened


@pytest_asyncio.fixture(scope="module", loop_scope="module")
async def a_can_scene(tmp_path_factory: pytest.TempPathFactory) -> AsyncIterator[Scene]:
    async with can_scene(tmp_path_factory.mktemp("can")) as opened:
        yield opened


@pytest_asyncio.fixture(scope="module", loop_scope="module")
async def a_service(tmp_path_factory: pytest.TempPathFactory) -> AsyncIterator[LiveService]:
    async with live_service(tmp_path_factory.mktemp("service")) as opened:
        yield opened


@pytest.fixture(scope="session")
def shown() -> Shown:
    """Put a fault in and see that what becomes of the arm is safe, in its time."""

    async def show(where: Where, faults: tuple[Fault[Where], ...], name: str) -> Observed:
        fault = next(fault for fault in faults if fault.name == name)
        troubles = []
        for _ in range(1 if fault.ends else ATTEMPTS):
            found = await observed(where, fault)
            said = trouble(found, fault)
            if not said:
                return found
            troubles.append(said)
        pytest.fail(f"{fault.what}: " + " | ".join(troubles))

    return show
