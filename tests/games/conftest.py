"""Workspaces that the games' tests share."""

from __future__ import annotations

from collections.abc import Callable

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


@pytest.fixture(scope="session")
def usual() -> Workspace:
    """A right arm's usual workspace."""
    return workspace()
