"""How old things are: running percentiles over the newest samples."""

from __future__ import annotations

from collections import deque

import numpy as np

from server.api.forms import Latencies, Percentiles
from server.api.live import Screen
from server.messages import LiveTick

KEPT = 2000
"""Samples that the percentiles are taken over: a minute at 30 Hz."""


class _Samples:
    def __init__(self) -> None:
        self._values_s: deque[float] = deque(maxlen=KEPT)

    def add(self, value_s: float) -> None:
        self._values_s.append(value_s)

    def percentiles(self) -> Percentiles:
        if not self._values_s:
            return Percentiles(p50_s=None, p99_s=None, samples=0)
        p50_s, p99_s = np.percentile(np.array(self._values_s), (50, 99))
        return Percentiles(p50_s=float(p50_s), p99_s=float(p99_s), samples=len(self._values_s))


class LatencyMeter:
    """Counts each datagram once: a tick that brought none would only say how long the sensors were silent."""

    def __init__(self) -> None:
        self._command = _Samples()
        self._pictures = {screen: _Samples() for screen in Screen}
        self._newest_received_s: float | None = None

    def commanded(self, tick: LiveTick) -> None:
        """A tick came from the station; its command had been given."""
        latency_s = tick.timing.datagram_to_command_s
        if latency_s is not None and tick.t_newest_received_s != self._newest_received_s:
            self._newest_received_s = tick.t_newest_received_s
            self._command.add(latency_s)

    def drawn(self, tick: LiveTick, screen: Screen, now_s: float) -> None:
        """A page has drawn a tick that brought a datagram it had not drawn before."""
        if tick.t_newest_received_s is not None:
            self._pictures[screen].add(now_s - tick.t_newest_received_s)

    def read(self) -> Latencies:
        """The percentiles as they stand."""
        return Latencies(
            datagram_to_command=self._command.percentiles(),
            datagram_to_picture=self._pictures[Screen.PATIENT].percentiles(),
            datagram_to_dashboard=self._pictures[Screen.DASHBOARD].percentiles(),
        )
