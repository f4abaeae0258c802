"""One thing that goes wrong: how it is put in and taken out again, what is safe then, and within what time (SR-8)."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractAsyncContextManager
from dataclasses import dataclass
from typing import Final, Generic, Protocol, TypeVar

from server.experiments.rig.scene import DriveProcess
from server.messages import DriveState, JointLimits

HEARTBEAT_S: Final = 0.25
STALE_S: Final = 0.1
WATCHDOG_S: Final = 0.1
TICK_S: Final = 0.01
SOON_S: Final = 2 * TICK_S
"""The tick that sees it, and the one that was under way."""
BRAKING_S: Final = 0.4
"""From the device's highest speed, 2 rad/s, at 10 rad/s² and with the jerk's time at both ends."""

HELD: Final = frozenset({DriveState.HOLD})
GOING: Final = frozenset({DriveState.ENGAGED, DriveState.HOLD})
UNMOVED: Final = frozenset({DriveState.ENGAGED})
UNHEARD: Final[frozenset[DriveState]] = frozenset()
"""Nobody is left who could say."""


class Place(Protocol):
    """Where a fault may be put in."""

    drive: DriveProcess

    async def mirroring(self) -> None:
        """Bring the arm to follow a moving patient."""
        ...

    def heard(self) -> tuple[DriveState | None, str]:
        """The station's state and reason now; None where it cannot be heard."""
        ...

    def decided_after_s(self, since_s: float) -> float | None:
        """From a moment to the station's first change of state."""
        ...

    @property
    def limits(self) -> tuple[JointLimits, ...]:
        """Of the patient."""
        ...


Where = TypeVar("Where", bound=Place)


@dataclass(frozen=True, slots=True)
class Fault(Generic[Where]):
    """One thing that goes wrong."""

    name: str
    what: str
    """For people."""
    put_in: Callable[[Where], AbstractAsyncContextManager[None]]
    """The fault is there while the block lasts."""
    safe: frozenset[DriveState]
    """States of which each is safe with this fault; with `ENGAGED` among them the arm may go on."""
    decided_within_s: float | None = None
    """From the fault to the station's change of state; None = the drive must see for itself, or it goes on."""
    still_within_s: float | None = None
    """From the fault to an arm that stands; None = it may go on, or cannot be measured."""
    words: tuple[str, ...] = ("",)
    """The reason that a person reads holds one of these."""
    watched_s: float = 0.8
    heard_after_s: float = 0.0
    """How long after the fault's end the station's state is asked for, where it cannot be heard before."""
    ends: bool = False
    """Nothing can be put in afterwards."""

    @property
    def goes_on(self) -> bool:
        """Whether the arm may follow on."""
        return DriveState.ENGAGED in self.safe
