"""The mist on a pane's cells, and how much of it has been wiped away."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fusion.messages import Floats


@dataclass(frozen=True, slots=True)
class Mist:
    """One picture's mist."""

    id: int
    in_play: NDArray[np.bool_]
    """(n,) which cells were misted at the beginning."""
    clear: Floats
    """(n,) 0 = mist .. 1 = clear."""

    @property
    def left(self) -> NDArray[np.intp]:
        """Numbers of the cells that are not clear."""
        return np.flatnonzero(self.in_play & (self.clear < 1.0))

    @property
    def share(self) -> float:
        """How much of what was misted is clear, 0..1."""
        return float(self.clear[self.in_play].mean())

    def clear_of(self, cells: tuple[int, ...]) -> Floats:
        """(len(cells),) how clear these are."""
        return np.asarray(self.clear[list(cells)])

    def wiped(self, under: NDArray[np.bool_], share: float) -> Mist:
        """The mist with so much more of it gone from the cells (n,) under the hand."""
        return replace(self, clear=np.where(under, np.minimum(self.clear + share, 1.0), self.clear))

    def signs(self, columns: int, *, backwards: bool) -> str:
        """Each cell as "0" (mist) to "9" (clear), "." where no mist ever was; rows joined by "/".

        Args:
            columns: cells in a row.
            backwards: each row from its end.
        """
        tenths = np.floor(self.clear * 9.0 + 1e-9).astype(int).tolist()
        signs = [str(tenth) if here else "." for tenth, here in zip(tenths, self.in_play.tolist(), strict=True)]
        rows = [signs[k : k + columns] for k in range(0, len(signs), columns)]
        return "/".join("".join(reversed(row) if backwards else row) for row in rows)


def mist(number: int, in_play: NDArray[np.bool_]) -> Mist:
    """Mist on these (n,) cells."""
    return Mist(number, in_play, np.zeros(len(in_play)))
