"""Moves one joint of an exoskeleton slowly, and holds it all the rest of the time, in a thread beside the questions.

Nothing moves but between `move` and its return; whatever ends it early (an error, Ctrl-C, a fault) holds at once.
"""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass
from types import TracebackType
from typing import Final, Self

import numpy as np

from fusion.errors import MachineError
from fusion.messages import Floats
from server.exoskeleton import Exoskeleton
from server.station.exo.driver import ZERO, Drive, DriveCommand, DriveMode, Joints
from server.station.exo.joint_map import JointMap

FASTEST_RAD_S: Final = 0.1
PEAK: Final = 1.875
"""Of a movement of least jerk: its greatest speed over its mean."""
PERIOD_S: Final = 0.01
SETTLE_S: Final = 0.3
LEAVE_S: Final = 0.1
"""The hold is said for so long before the drive is closed."""


@dataclass(frozen=True, slots=True)
class Way:
    """One movement of every joint, of which all but one stand."""

    begun_s: float
    lasts_s: float
    from_rad: Floats  # (n,)
    by_rad: Floats  # (n,)

    def at(self, now_s: float) -> tuple[Floats, Floats, bool]:
        """Set-points, their velocities, and whether it is over: q = q₀ + Δ (10 u³ − 15 u⁴ + 6 u⁵)."""
        u = min(max((now_s - self.begun_s) / self.lasts_s, 0.0), 1.0)
        share, speed = u**3 * (10 - 15 * u + 6 * u * u), 30 * u * u * (1 - u) ** 2 / self.lasts_s
        return self.from_rad + share * self.by_rad, speed * self.by_rad, u >= 1.0


class Mover:
    """An open drive, held; a context manager that ends holding.

    Args:
        drive: open.
        exoskeleton: what it is.
    """

    def __init__(self, drive: Drive, exoskeleton: Exoskeleton) -> None:
        self._drive, self._map = drive, JointMap(exoskeleton)
        self._joints = exoskeleton.joints
        self._way: Way | None = None
        self._still, self._end = threading.Event(), threading.Event()
        self._still.set()
        self.reading = drive.read(time.monotonic())
        """The newest."""
        self._angle: Joints = self.reading.angle_rad
        self._failed: Exception | None = None
        self._thread = threading.Thread(target=self._keep, name="mover", daemon=True)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.hold()
        time.sleep(LEAVE_S)
        self._end.set()
        self._thread.join()

    def hold(self) -> None:
        """Stand where the set-point is now, at once."""
        self._way = None
        self._still.set()

    def joint_rad(self, index: int) -> float:
        """Where a joint is measured; a joint that follows nothing is not known here."""
        return float(self._map.joints_rad(self.reading.angle_rad)[index])

    def move(self, index: int, by_rad: float) -> None:
        """Move one joint and return when it stands.

        Args:
            index: of the joint, which follows an angle.
            by_rad: how far, as the joint counts.

        Raises:
            MachineError: the drive reports a fault; it holds.
        """
        self._require_sound()
        by = np.where(np.arange(len(self._joints)) == index, by_rad, 0.0)
        self._still.clear()
        lasts_s = PEAK * abs(by_rad) / FASTEST_RAD_S
        self._way = Way(time.monotonic(), lasts_s, self._map.joints_rad(self._angle), by)
        try:
            self._still.wait()
            time.sleep(SETTLE_S)
        finally:
            self.hold()
        self._require_sound()

    def step(self, now_s: float) -> None:
        """One tick: measure, and command the way or a hold."""
        self.reading = self._drive.read(now_s)
        way, velocity = self._way, ZERO
        if self.reading.fault:
            self.hold()
        elif way is not None:
            joints, speeds, over = way.at(now_s)
            self._angle, velocity = self._map.anatomical_rad(joints), self._map.anatomical_rad_s(speeds)
            if over:
                self.hold()
        self._drive.command(self._command(velocity), now_s)

    def _command(self, velocity: Joints) -> DriveCommand:
        moving = any(velocity)
        reason = "" if moving else "held by the wizard"
        return DriveCommand(DriveMode.FOLLOW if moving else DriveMode.HOLD, self._angle, velocity, reason)

    def _keep(self) -> None:
        try:
            while not self._end.is_set():
                self.step(time.monotonic())
                self._end.wait(PERIOD_S)
        except Exception as error:
            self._failed = error
            self._still.set()

    def _require_sound(self) -> None:
        if self._failed is not None:
            raise MachineError(f"The drive has failed: {self._failed}", "a drive that works")
        if self.reading.fault:
            raise MachineError(f"The drive reports: {self.reading.fault}", "no fault", "mend it and begin again")
