"""SPARC and LDLJ agree with their authors' program, and obey their laws."""

from __future__ import annotations

import csv
import gzip
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fusion.messages import Floats
from fusion.metrics.smoothness import dimensionless_jerk, log_dimensionless_jerk, sparc


def velocities(folder: Path) -> dict[str, Floats]:
    found: dict[str, list[list[float]]] = {}
    with gzip.open(folder / "velocities.csv.gz", "rt") as lines:
        for row in csv.DictReader(lines):
            found.setdefault(row["id"], []).append([float(row[axis]) for axis in ("vx", "vy", "vz")])
    return {name: np.array(rows) for name, rows in found.items()}


@pytest.mark.recordings
def test_every_reference_movement_has_the_reference_smoothness(recordings: Path) -> None:
    folder = recordings.parent / "reference" / "smoothness"
    moves = velocities(folder)
    with (folder / "expected.csv").open() as lines:
        rows = list(csv.DictReader(lines))
    assert len(rows) == 50
    for row in rows:
        velocity, rate_hz = moves[row["id"]], float(row["fs"])
        speed = np.linalg.norm(velocity, axis=1)
        assert sparc(speed, rate_hz) == pytest.approx(float(row["sparc"]), abs=1e-4), row["id"]
        assert sparc(speed, rate_hz, 20.0) == pytest.approx(float(row["sparc_fc20"]), abs=1e-4), row["id"]
        assert dimensionless_jerk(velocity, rate_hz) == pytest.approx(float(row["dlj_vel"]), rel=1e-4), row["id"]
        assert log_dimensionless_jerk(velocity, rate_hz) == pytest.approx(float(row["ldlj_vel"]), abs=1e-4), row["id"]


def bell(duration_s: float = 1.0, rate_hz: float = 100.0) -> Floats:
    """Minimum-jerk speed."""
    u = np.arange(0, 1, 1 / (rate_hz * duration_s))
    return 30 * u**2 * (1 - u) ** 2


def test_the_papers_gaussian_has_the_papers_value() -> None:
    speed = np.exp(-5 * np.arange(-1, 1, 0.01) ** 2)
    assert sparc(speed, 100.0) == pytest.approx(-1.41403, abs=1e-4)


@given(scale=st.floats(0.01, 100))
def test_smoothness_does_not_depend_on_the_unit(scale: float) -> None:
    assert sparc(scale * bell(), 100.0) == pytest.approx(sparc(bell(), 100.0), abs=1e-9)
    assert dimensionless_jerk(scale * bell(), 100.0) == pytest.approx(dimensionless_jerk(bell(), 100.0))


def test_a_movement_in_two_parts_is_less_smooth_than_one_of_one_part() -> None:
    halting = np.concatenate([bell(0.5), np.zeros(20), bell(0.5)])
    assert sparc(halting, 100.0) < sparc(bell(), 100.0) - 0.3
    assert log_dimensionless_jerk(halting, 100.0) < log_dimensionless_jerk(bell(), 100.0)
