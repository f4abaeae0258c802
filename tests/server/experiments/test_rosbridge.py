"""The experiment on the robot behind rosbridge, run small: every figure is there and none is made up."""

from __future__ import annotations

import math

from fusion.experiments.experiment import Setup
from server.experiments.catalogue.rosbridge import EXPERIMENT


def test_sr3_sr8_it_says_how_a_robot_follows_stops_and_fails():
    outcome = EXPERIMENT.run(Setup(seed=2, effort=0.01))
    rows = {row[0]: row[1:] for row in outcome.tables[0].rows}
    for typed in ("silent", "frozen", "drop"):
        count, *times_ms = rows[f"fault after '{typed}'"]
        assert count == 1
        assert all(0 < value < 5000 for value in times_ms)
    assert rows["a command, processor time in the loop"][0] > 20
    assert all(math.isfinite(value) for row in rows.values() for value in row)
    assert len(outcome.beside) == 5
    assert outcome.seeds == (2,)
