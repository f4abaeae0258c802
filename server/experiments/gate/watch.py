"""Watches one fault: from when it counts, when the gate has left `engaged`, and when the set-points rest."""

from __future__ import annotations

from dataclasses import dataclass

from server.experiments.gate.faults import Fault, Moment
from server.experiments.gate.rig import TICK_S
from server.messages import DriveState


@dataclass(slots=True)
class Watch:
    """Of one fault."""

    fault: Fault
    engaged: bool
    """The gate was, when it began: otherwise there is nothing to see."""
    late: bool = False
    _counts_s: float | None = None
    _safe_s: float | None = None
    _rests_s: float | None = None

    @property
    def to_safe_s(self) -> float | None:
        """From when it counted to the gate's having left engaged; None = it had no cause to, or another."""
        return None if self._counts_s is None or self._safe_s is None else self._safe_s - self._counts_s

    @property
    def to_rest_s(self) -> float | None:
        """From the gate's having left engaged to the set-points' rest; None = they did not rest, or it was resumed."""
        return None if self._safe_s is None or self._rests_s is None else self._rests_s - self._safe_s

    def look(self, moment: Moment) -> None:
        """After each of its ticks."""
        if not self.engaged or self._rests_s is not None:
            return
        if self._safe_s is None:
            self._until_safe(moment)
        elif moment.rig.state.at_rest:
            self._rests_s = moment.rig.t_s

    def _until_safe(self, moment: Moment) -> None:
        rig = moment.rig
        if self._counts_s is None and self.fault.counts(moment):
            self._counts_s = rig.t_s - TICK_S
        elif not self.fault.counts(moment):
            self._counts_s = None
        if rig.now is not DriveState.ENGAGED:
            self._safe_s = rig.t_s
        elif self._counts_s is not None and rig.t_s - self._counts_s > self.fault.within_s:
            self.late = True
