"""What may happen to datagrams on their way: each is a function of one datagram to those that arrive in its place."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np

Wire = Callable[[bytes], list[bytes]]

REORDERED_AMONG: Final = 27
"""A whole frame of a `kinectv2-osc` sensor arrives in another order."""


def whole(datagram: bytes) -> list[bytes]:
    """Everything arrives as it was sent."""
    return [datagram]


def cut(_: bytes) -> list[bytes]:
    """Nothing arrives: the plug is out."""
    return []


def doubled(datagram: bytes) -> list[bytes]:
    """Everything arrives twice."""
    return [datagram, datagram]


def half_dropped(seed: int) -> Wire:
    """Every other datagram, by chance, is lost."""
    random = np.random.default_rng(seed)
    return lambda datagram: [datagram] if random.random() < 0.5 else []


def reordered(seed: int) -> Wire:
    """Datagrams wait for one another and arrive in any order."""
    random = np.random.default_rng(seed)
    waiting: list[bytes] = []

    def wire(datagram: bytes) -> list[bytes]:
        waiting.append(datagram)
        if len(waiting) < REORDERED_AMONG:
            return []
        arriving = [waiting[k] for k in random.permutation(len(waiting))]
        waiting.clear()
        return arriving

    return wire


def corrupted(seed: int) -> Wire:
    """In every other datagram, by chance, some bytes are others."""
    random = np.random.default_rng(seed)

    def wire(datagram: bytes) -> list[bytes]:
        if random.random() < 0.5:
            return [datagram]
        bent = bytearray(datagram)
        for place in random.integers(0, len(bent), 3):
            bent[place] = int(random.integers(0, 256))
        return [bytes(bent)]

    return wire
