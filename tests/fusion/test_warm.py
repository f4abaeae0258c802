"""What is warmed is what a session runs."""

from __future__ import annotations

import pytest

from fusion.estimation import METHODS
from fusion.warm import warm


@pytest.mark.parametrize("method", METHODS)
def test_warming_goes_all_the_way_from_two_sensors_to_a_mirrored_arm(method: str) -> None:
    told = warm(method)
    assert [sensor.aligned for sensor in told.sensors] == [True, True]
    assert told.fused is not None
    assert told.target is not None
