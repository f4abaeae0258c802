"""A recording gives the same ticks twice: in one process, in another one, and in plain Python without compiled code."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from fusion.estimation import METHODS
from fusion.offline import fuse_recording
from fusion.recording.reader import read_recording
from fusion.recording.writer import write_recording
from fusion.virtual_patient.trial import virtual_recording

SCRIPT = """
import sys
import numpy as np
from pathlib import Path
from fusion.offline import fuse_recording
from fusion.recording.reader import read_recording
fused = fuse_recording(read_recording(Path(sys.argv[1])), sys.argv[3], causal=sys.argv[4] == "live")
told = [[*t.direction_in_limb, t.twist_rad, t.elbow_rad] if t else [np.nan] * 5 for t in fused.target]
np.savez(sys.argv[2], t_s=fused.t_s, positions=fused.positions, bound_m=fused.bound_m, state=fused.state, told=told)
"""
NAMES = ("t_s", "positions", "bound_m", "state", "told")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A short made-up recording as it is kept."""
    path = tmp_path_factory.mktemp("made") / "up"
    write_recording(virtual_recording(3, 2.0), path)
    return path


def told_here(folder: Path, method: str, how: str) -> dict[str, np.ndarray]:
    fused = fuse_recording(read_recording(folder), method, causal=how == "live")
    told = [[*t.direction_in_limb, t.twist_rad, t.elbow_rad] if t else [np.nan] * 5 for t in fused.target]
    return dict(zip(NAMES, (fused.t_s, fused.positions, fused.bound_m, fused.state, np.array(told)), strict=True))


def told_elsewhere(folder: Path, method: str, how: str, out: Path, **environment: str) -> dict[str, np.ndarray]:
    """The same in a process of its own."""
    paths = {"PYTHONPATH": os.pathsep.join(sys.path)}
    command = [sys.executable, "-c", SCRIPT, str(folder), str(out), method, how]
    subprocess.run(command, env={**os.environ, **paths, **environment}, check=True, capture_output=True)
    return dict(np.load(out))


@pytest.mark.parametrize("method", METHODS)
def test_to_the_last_bit_in_one_process(folder: Path, method: str) -> None:
    first, second = told_here(folder, method, "live"), told_here(folder, method, "live")
    for name in NAMES:
        np.testing.assert_array_equal(first[name], second[name])
    assert np.isfinite(first["told"]).any()


def test_to_the_last_bit_in_a_process_that_orders_names_differently(folder: Path, tmp_path: Path) -> None:
    here = told_here(folder, "set-membership", "live")
    there = told_elsewhere(folder, "set-membership", "live", tmp_path / "there.npz", PYTHONHASHSEED="5")
    for name in NAMES:
        np.testing.assert_array_equal(here[name], there[name])


def test_to_a_nanometre_without_compiled_code(folder: Path, tmp_path: Path) -> None:
    here = told_here(folder, "set-membership", "whole")
    plain = told_elsewhere(folder, "set-membership", "whole", tmp_path / "plain.npz", NUMBA_DISABLE_JIT="1")
    for name in NAMES:
        np.testing.assert_allclose(here[name], plain[name], rtol=1e-9, atol=1e-9)
