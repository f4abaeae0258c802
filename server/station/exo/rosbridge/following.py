"""Whether the robot is where it is told to be, and how it is taken over from where it stands (SR-6)."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from fusion.messages import Floats
from server.station.exo.joining import gap_rad

NEAR_RAD = 0.1
"""A robot that was not commanded is taken over only from as near as this."""
CLOSING_RAD_S = 0.1
"""What then lies between it and what it is told is closed at this speed: it never jumps."""
LONGEST_S = 0.02
"""However late a tick is, the gap closes by no more than this long."""
FAR_FOR_S = 0.3
"""So long it may be further away than allowed."""


@dataclass(frozen=True, slots=True)
class Following:
    """What is known of it."""

    joined: bool = False
    """It was near what it was told, and may be commanded from then on."""
    gap_rad: Floats = field(default_factory=lambda: np.zeros(1))
    """(n,) added to what it is told."""
    wanted_rad: Floats = field(default_factory=lambda: np.zeros(1))
    """(n,) what it was told last, without the gap."""
    near_s: float | None = None
    """When it was last as near as it should be."""
    last_s: float = 0.0
    fault: str = ""

    @property
    def closing_rad_s(self) -> Floats:
        """(n,) velocity of the gap."""
        closing: Floats = -CLOSING_RAD_S * np.sign(self.gap_rad)
        return closing

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
        gap = self._closed(wanted, measured, now_s) if self.joined else measured - wanted
        after = replace(self, joined=joined, gap_rad=gap, wanted_rad=wanted, last_s=now_s)
        if not moving or self.near_s is None or apart[worst] <= (within_rad if joined else NEAR_RAD):
            return replace(after, near_s=now_s, fault="")
        far = now_s - self.near_s > FAR_FOR_S
        words = f"'{names[worst]}' does not follow: it is {apart[worst]:.2f} rad from where it is told to be."
        return replace(after, fault=words if far else "")

    def _closed(self, wanted: Floats, measured: Floats, now_s: float) -> Floats:
        left = gap_rad(self.wanted_rad, self.gap_rad, wanted, measured)
        less = np.maximum(np.abs(left) - CLOSING_RAD_S * min(now_s - self.last_s, LONGEST_S), 0.0)
        gap: Floats = np.sign(left) * less
        return gap
