"""Kernels are kept between processes, and never longer than what they were compiled from."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

HELPER = """
from fusion.compiled import kernel

@kernel
def twice(x):
    return {factor} * x
"""
CALLER = """
from fusion.compiled import kernel
from helper import twice

@kernel
def called(x):
    return twice(x) + 1

print(called(3), sum(called.stats.cache_hits.values()))
"""


def called_in_a_new_process(folder: Path, **environment: str) -> str:
    done = subprocess.run(
        [sys.executable, "-W", "error", "caller.py"],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), **environment},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.stdout.strip() or done.stderr


def written(folder: Path) -> Path:
    (folder / "helper.py").write_text(HELPER.format(factor=2))
    (folder / "caller.py").write_text(CALLER)
    return folder


def test_a_kernel_is_loaded_by_the_next_process(tmp_path: Path) -> None:
    folder = written(tmp_path)
    assert called_in_a_new_process(folder) == "7 0"
    assert called_in_a_new_process(folder) == "7 1"


def test_a_kernel_is_compiled_anew_when_a_file_beside_it_changes(tmp_path: Path) -> None:
    """Numba alone would go on with what another file said when this one was compiled."""
    folder = written(tmp_path)
    called_in_a_new_process(folder)
    (folder / "helper.py").write_text(HELPER.format(factor=5))
    assert called_in_a_new_process(folder) == "16 0"


def test_where_nothing_can_be_kept_kernels_work_all_the_same(tmp_path: Path) -> None:
    folder = written(tmp_path)
    (folder / "__pycache__").write_text("no folder")
    nowhere = {"HOME": "/dev/null", "XDG_CACHE_HOME": "/dev/null", "NUMBA_CACHE_DIR": ""}
    assert called_in_a_new_process(folder, **nowhere) == "7 0"
