"""Whether the robot is where it is told to be."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from fusion.messages import Floats

NEAR_RAD = 0.1
"""A robot that was not commanded is taken over only from where it stands."""
FAR_FOR_S = 0.3
"""So long it may be further away than allowed."""


@dataclass(frozen=True, slots=True)
class Following:
    """What is known of it."""

    joined: bool = False
    """It was near what it was told, and may be commanded from then on."""
    near_s: float | None = None
    """When it was last as near as it should be."""
    fault: str = ""

    def step(
        self, names: tuple[str, ...], wanted: Floats, measured: Floats, moving: bool, within_rad: float, now_s: float
    ) -> Following:
        """One tick's comparison.

        Args:
            names: of the joints.
            wanted: (n,) rad, where they are told to be.
            measured: (n,) rad, where they are.
            moving: a robot that only holds may be moved by hand.
            within_rad: how near is near enough.
            now_s: the time.
        """
        apart = np.abs(wanted - measured)
        worst = int(np.argmax(apart))
        joined = self.joined or bool(apart[worst] <= NEAR_RAD)
        if not moving or self.near_s is None or apart[worst] <= (within_rad if joined else NEAR_RAD):
            return replace(self, joined=joined, near_s=now_s, fault="")
        far = now_s - self.near_s > FAR_FOR_S
        words = f"'{names[worst]}' does not follow: it is {apart[worst]:.2f} rad from where it is told to be."
        return replace(self, joined=joined, fault=words if far else "")
