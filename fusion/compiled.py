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
    """A record with these fields, for arrays whose elements a kernel reads as `joint.position`."""
    return np.dtype((np.record, np.dtype(fields, align=True)))


def _kept(function: Callable[..., Any]) -> Any:
    make: Any = FunctionCache
    try:
        kept = make(function)
    except RuntimeError:  # no folder can be written
        return None
    folder = Path(getfile(function)).parent
    stamp = _content(ESTIMATION) + _content(folder)
    file: Any = IndexDataCacheFile
    kept._cache_file = file(kept.cache_path, kept._impl.filename_base, stamp)
    return kept


@cache
def _content(folder: Path) -> bytes:
    """What stands in the folder's modules."""
    digest = sha256()
    for file in sorted(folder.glob("*.py")):
        digest.update(file.read_bytes())
    return digest.digest()
