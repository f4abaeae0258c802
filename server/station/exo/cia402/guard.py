"""Whether the drives may follow: powered together, stopped together by the first fault, and reset by a person only."""

from __future__ import annotations

import logging
from collections.abc import Iterable, Sequence

from server.station.exo.cia402.link import Link
from server.station.exo.cia402.states import State, Wanted
from server.station.exo.cia402.watch import Patience, not_enabled, trouble

log = logging.getLogger(__name__)

POWER_WITHIN_S = 1.0
"""From the first look, or a person's reset, to every drive in operation."""
COMING_BACK = "The drives are being switched on again; they do not hold yet."


class Guard:
    """Holds what is wanted of the drives, and the latched fault.

    Args:
        links: the drives.
        patience: how long a drive may be silent.
    """

    def __init__(self, links: Sequence[Link], patience: Patience) -> None:
        self._links, self._patience = links, patience
        self.fault, self.wanted = "", Wanted.ENABLED
        self.powered = False
        """Every drive is in operation."""
        self._asked_s: float | None = None
        self._coming_back = False

    @property
    def said(self) -> str:
        """The fault, or that a reset is still under way: until every drive holds, there is one."""
        return self.fault or (COMING_BACK if self._coming_back else "")

    def judge(self, now_s: float, said: str) -> bool:
        """Look once per tick.

        Args:
            now_s: monotonic time.
            said: what else is wrong, with the bus or the patient's range; "" = nothing.

        Returns:
            Whether a fault has been found now. From then on the drives are wanted standing, until `reset`.
        """
        if self._asked_s is None:
            self._begin(now_s)
        if self.fault:
            return False
        self.fault = said or (self._fault_in_operation(now_s) if self.powered else self._power_up(now_s))
        if self.fault:
            self.wanted, self.powered = Wanted.STANDING, False
            log.error("%s", self.fault)
        return bool(self.fault)

    def reset(self) -> None:
        """A person asks: out of the fault, and powered where the joints stand (SR-5)."""
        for link in self._links:
            link.forgive()
        self.fault, self.wanted, self.powered, self._asked_s = "", Wanted.RESET, False, None
        self._coming_back = True

    def stand(self) -> None:
        """The end: quick stop."""
        self.wanted, self.powered = Wanted.STANDING, False

    def _begin(self, now_s: float) -> None:
        """At the start silence counts from the first look: what came before may still wait to be read."""
        self._asked_s = now_s
        if not self._coming_back:
            for link in self._links:
                link.heard_s = max(link.heard_s, now_s)

    def _fault_in_operation(self, now_s: float) -> str:
        return self._trouble(now_s) or _first(map(not_enabled, self._waiting()))

    def _power_up(self, now_s: float) -> str:
        """On the way to operation; a fault that a person asked to leave is no news until the time is over."""
        waiting, found = self._waiting(), self._trouble(now_s)
        if not waiting and not found:
            self.powered, self.wanted, self._coming_back = True, Wanted.ENABLED, False
            return ""
        if self._asked_s is not None and now_s - self._asked_s > POWER_WITHIN_S:
            return found or _first(map(not_enabled, waiting))
        if self.wanted is Wanted.RESET:
            left = all(link.measured.statusword and link.state is not State.FAULT for link in self._links)
            self.wanted = Wanted.ENABLED if left else Wanted.RESET
            return ""
        return found

    def _waiting(self) -> list[Link]:
        return [link for link in self._links if link.state is not State.ENABLED]

    def _trouble(self, now_s: float) -> str:
        return _first(trouble(link, self._patience, now_s) for link in self._links)


def _first(said: Iterable[str]) -> str:
    return next((each for each in said if each), "")
