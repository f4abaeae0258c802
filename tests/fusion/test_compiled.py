"""Kernels are kept between processes, and never longer than what they were compiled from."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np

from fusion.compiled import Record, kernel, record

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
        [sys.executable, "-B", "-W", "error", "caller.py"],  # -B: a file rewritten within a second is read anew
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


def test_a_kernel_called_with_a_type_that_is_gone_is_compiled_anew(tmp_path: Path) -> None:
    """What is kept of it names the type; a module of another folder took it away."""
    folder, other = written(tmp_path), tmp_path / "other"
    other.mkdir()
    caller = "from typing import NamedTuple\nfrom far import total\nclass {name}(NamedTuple):\n    x: int\n"
    (folder / "far.py").write_text("from fusion.compiled import kernel\n@kernel\ndef total(a):\n    return a.x + 1\n")
    for name in ("Before", "After"):
        (other / "caller.py").write_text("")
        (other / "near.py").write_text(caller.format(name=name) + f"print(total({name}(3)))\n")
        (folder / "caller.py").write_text("import sys; sys.path.insert(0, 'other'); import near")
        assert called_in_a_new_process(folder) == "4"


def test_only_one_version_of_a_kernel_is_kept(tmp_path: Path) -> None:
    folder = written(tmp_path)
    for factor in (2, 5):
        (folder / "helper.py").write_text(HELPER.format(factor=factor))
        called_in_a_new_process(folder)
    assert len(list(folder.glob("__pycache__/caller.called-*.nbi"))) == 1
    assert len(list(folder.glob("__pycache__/caller.called-*.nbc"))) == 1


def test_where_nothing_can_be_kept_kernels_work_all_the_same(tmp_path: Path) -> None:
    folder = written(tmp_path)
    (folder / "__pycache__").write_text("no folder")
    nowhere = {"HOME": "/dev/null", "XDG_CACHE_HOME": "/dev/null", "NUMBA_CACHE_DIR": ""}
    assert called_in_a_new_process(folder, **nowhere) == "7 0"


def test_a_record_is_not_taken_for_one_that_begins_alike() -> None:
    """Numba would use what it compiled for the shorter one, and warn, but only if that one came first."""
    position = ("position", "f8", (3,))
    for fields in ([position], [position, ("seen_s", "f8")]):
        assert first_of(np.ones(2, record(fields))[0]) == 1.0
    assert len(first_of.signatures) == 2


@kernel
def first_of(joint: Record) -> float:
    return joint.position[0]
