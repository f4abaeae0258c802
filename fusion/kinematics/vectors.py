"""Vectors of three numbers inside kernels; any of them may be a tuple or an array."""

from __future__ import annotations

from math import atan2, isnan, nan, sqrt
from typing import TypeAlias

from fusion.compiled import kernel
from fusion.messages import Floats

Vector: TypeAlias = tuple[float, float, float]
Triple: TypeAlias = Vector | Floats


@kernel
def row(array: Floats, j: int) -> Vector:
    """Row `j` of an array (J, 3)."""
    return (array[j, 0], array[j, 1], array[j, 2])


@kernel
def step(array: Floats, start: int, end: int, times: float) -> Vector:
    """From row `start` of an array (J, 3) to row `end`, `times` as long."""
    a, b = row(array, start), row(array, end)
    return (times * (b[0] - a[0]), times * (b[1] - a[1]), times * (b[2] - a[2]))


@kernel
def between(array: Floats, j: int, k: int) -> Vector:
    """Mid-point of two rows of an array (J, 3)."""
    a, b = row(array, j), row(array, k)
    return (0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2]))


@kernel
def sum_of(a: Triple, b: Triple, times: float) -> Vector:
    """The sum a + times b."""
    return (a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2])


@kernel
def dot(a: Triple, b: Triple) -> float:
    """The product a · b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@kernel
def cross(a: Triple, b: Triple) -> Vector:
    """The product a × b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@kernel
def length(a: Triple) -> float:
    """|a|."""
    return sqrt(dot(a, a))


@kernel
def unit(a: Triple) -> Vector:
    """The direction a / |a|; NaN for no vector at all."""
    size = length(a)
    if size == 0.0:
        return (nan, nan, nan)
    return (a[0] / size, a[1] / size, a[2] / size)


@kernel
def angle_between(a: Triple, b: Triple) -> float:
    """Angle of two unit vectors, exact near 0 and π too."""
    return 2.0 * atan2(length(sum_of(a, b, -1.0)), length(sum_of(a, b, 1.0)))


@kernel
def known_or(a: Vector, b: Vector) -> Vector:
    """a, unless a part of it is NaN."""
    return b if isnan(a[0]) or isnan(a[1]) or isnan(a[2]) else a
