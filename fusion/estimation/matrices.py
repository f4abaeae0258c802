"""Symmetric 3×3 matrices inside kernels."""

from __future__ import annotations

from math import acos, cos, sqrt

import numpy as np

from fusion.compiled import kernel
from fusion.messages import Floats


@kernel
def largest_eigenvalue(A: Floats) -> float:
    """Of the first three rows and columns; off by 1e-8 of itself at most, where eigenvalues nearly meet.

    O. K. Smith: Eigenvalues of a symmetric 3 × 3 matrix. Communications of the ACM 4(4), 1961.
    """
    mean: float = (A[0, 0] + A[1, 1] + A[2, 2]) / 3
    x, y, z = A[0, 0] - mean, A[1, 1] - mean, A[2, 2] - mean
    off = A[0, 1] ** 2 + A[0, 2] ** 2 + A[1, 2] ** 2
    p = sqrt((x * x + y * y + z * z + 2 * off) / 6)
    if p == 0.0:
        return mean
    det = x * (y * z - A[1, 2] ** 2) - A[0, 1] * (A[0, 1] * z - A[1, 2] * A[0, 2])
    det += A[0, 2] * (A[0, 1] * A[1, 2] - y * A[0, 2])
    return mean + 2 * p * cos(acos(min(max(det / (2 * p**3), -1.0), 1.0)) / 3)


@kernel
def inverse(A: Floats) -> Floats:
    """(3, 3) A⁻¹ of a positive definite A, by its cofactors."""
    found = np.empty((3, 3))
    for i in range(3):
        for k in range(3):
            a, b, c, d = (k + 1) % 3, (k + 2) % 3, (i + 1) % 3, (i + 2) % 3
            found[i, k] = A[a, c] * A[b, d] - A[a, d] * A[b, c]
    det = A[0, 0] * found[0, 0] + A[0, 1] * found[1, 0] + A[0, 2] * found[2, 0]
    for i in range(3):
        for k in range(3):
            found[i, k] /= det
    return found
