"""Vectors of three numbers inside kernels."""

from __future__ import annotations

from math import sqrt
from typing import TypeAlias

from fusion.compiled import kernel
from fusion.messages import Floats

Vector: TypeAlias = tuple[float, float, float]


@kernel
def row(array: Floats, j: int) -> Vector:
    """Row `j` of an array (J, 3)."""
    return (array[j, 0], array[j, 1], array[j, 2])


@kernel
def put(array: Floats, j: int, a: Vector) -> None:
    """Write row `j` of an array (J, 3)."""
    array[j, 0], array[j, 1], array[j, 2] = a[0], a[1], a[2]


@kernel
def plus(a: Vector | Floats, b: Vector | Floats, times: float) -> Vector:
    """A + times b."""
    return (a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2])


@kernel
def widened(a: Vector, by: float) -> Vector:
    """The same number more on every axis."""
    return (a[0] + by, a[1] + by, a[2] + by)


@kernel
def dot(a: Vector, b: Vector) -> float:
    """The inner product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@kernel
def length(a: Vector) -> float:
    """|a|."""
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])


@kernel
def distance(a: Vector | Floats, b: Vector | Floats) -> float:
    """|a - b|."""
    return length(plus(a, b, -1.0))
