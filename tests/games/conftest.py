"""Workspaces that the games' tests share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import radians

import pytest

from fusion.skeleton import Side
from games.game import Workspace


def workspace(side: Side = Side.RIGHT) -> Workspace:
    outward = 1.0 if side is Side.RIGHT else -1.0
    return Workspace(
        side=side,
        shoulder=(0.18 * outward, 0.0, 0.0),
        upper_arm_m=0.28,
        forearm_m=0.33,
        plane_rad=(0.2, 1.8),
        elevation_rad=(0.2, 1.5),
        rotation_rad=(-0.8, 0.8),
        elbow_rad=(0.2, 2.0),
    )


@pytest.fixture(scope="session")
def workspace_of() -> Callable[[Side], Workspace]:
    """A usual workspace of a side."""
    return workspace


SMALL = {
    "15 degrees": ((40.0, 55.0), (40.0, 55.0), (-7.0, 8.0), (60.0, 75.0)),
    "25 degrees, nearly straight": ((0.0, 25.0), (20.0, 45.0), (-7.0, 8.0), (20.0, 45.0)),
}
"""Plane, elevation, rotation and elbow in degrees, of arms that move little."""


@pytest.fixture(scope="session", params=list(SMALL))
def small_workspace_of(request: pytest.FixtureRequest) -> Callable[[Side], Workspace]:
    """A small workspace of a side."""
    plane, elevation, rotation, elbow = ((radians(low), radians(high)) for low, high in SMALL[request.param])
    ranges = {"plane_rad": plane, "elevation_rad": elevation, "rotation_rad": rotation, "elbow_rad": elbow}
    return lambda side: replace(workspace(side), **ranges)


@pytest.fixture(scope="session")
def usual() -> Workspace:
    """A right arm's usual workspace."""
    return workspace()
