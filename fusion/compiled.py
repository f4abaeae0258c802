"""Kernels: plain scalar functions over joints, compiled by numba and kept on disk (docs/decisions/compiled-kernels.md).

A kernel may call kernels of other files. Numba keeps the compiled form as long as the kernel's own file is the same;
here it is kept as long as every file of the kernel's folder and of `fusion/estimation` is.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from hashlib import sha256
from inspect import getfile
from pathlib import Path
from typing import Any, Final, TypeAlias, TypeVar

import numpy as np
from numba import njit
from numba.core.caching import FunctionCache, IndexDataCacheFile
from numpy.typing import NDArray

ESTIMATION: Final = Path(__file__).parent / "estimation"
Record: TypeAlias = Any
"""One record inside a kernel; its fields are those of its dtype, and assigning to one writes into the array."""
Records: TypeAlias = NDArray[Any]
"""An array of records."""
Function = TypeVar("Function", bound=Callable[..., Any])


def kernel(function: Function) -> Function:
    """Compile at the first call with arguments of one kind, or load what an earlier process compiled.

    Kept in `__pycache__` beside the source, else in the user's cache folder, else (`NUMBA_CACHE_DIR`) where told; where
    nothing can be written each process compiles anew. With `NUMBA_DISABLE_JIT=1` the function stays plain Python.
    """
    compiled: Any = njit(error_model="numpy")(function)
    if compiled is not function:
        compiled._cache = _kept(function) or compiled._cache
    done: Function = compiled
    return done


def record(fields: list[Any]) -> np.dtype[np.void]:
    """A record with these fields, for arrays whose elements a kernel reads as `joint.position`.

    A field of its own beside them keeps numba from taking it for another record that begins alike, with a warning.
    """
    kind = f"kind_{sha256(repr(fields).encode()).hexdigest()[:8]}"
    return np.dtype((np.record, np.dtype([*fields, (kind, "i8")], align=True)))


def _kept(function: Callable[..., Any]) -> Any:
    make: Any = FunctionCache
    try:
        kept = make(function)
    except RuntimeError:  # no folder can be written
        return None
    folder = Path(getfile(function)).parent
    kept._cache_file = _Files(kept.cache_path, kept._impl.filename_base, _content(ESTIMATION) + _content(folder))
    return kept


class _Files(IndexDataCacheFile):
    """What is kept of one kernel, in files named by what they were compiled from; others of that kernel are removed.

    So two versions never read what the other writes at the same moment. What names a type that is gone, a caller's in
    another folder, cannot be read at all; it is compiled anew.
    """

    def __init__(self, folder: str, kernel_name: str, stamp: bytes) -> None:
        begin: Any = super().__init__
        begin(folder, f"{kernel_name}-{sha256(stamp).hexdigest()[:12]}", stamp)
        self._base: Any = super()
        name, _, line_and_python = kernel_name.rpartition("-")
        self._others = f"{name}-*.{line_and_python.partition('.')[2]}-*.nb?"

    def load(self, key: object) -> object:
        try:
            return self._base.load(key)
        except (AttributeError, ImportError):
            return None

    def _load_index(self) -> Any:
        try:
            return self._base._load_index()
        except (AttributeError, ImportError):
            return {}

    def _save_index(self, overloads: object) -> None:
        self._base._save_index(overloads)
        ours = Path(self._index_name).stem
        for file in Path(self._cache_path).glob(self._others):
            if not file.name.startswith(ours):
                file.unlink(missing_ok=True)


@cache
def _content(folder: Path) -> bytes:
    """What stands in the folder's modules."""
    digest = sha256()
    for file in sorted(folder.glob("*.py")):
        digest.update(file.read_bytes())
    return digest.digest()
