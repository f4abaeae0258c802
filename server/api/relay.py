"""Joins each tick with the game's picture and the session, and gives it to whoever looks."""

from __future__ import annotations

from functools import cached_property

import msgspec

from server.api.latency import LatencyMeter
from server.api.live import LiveMessage
from server.api.newest import FanOut
from server.api.therapy import Therapy
from server.messages import LiveTick

_encoder = msgspec.json.Encoder()


class Broadcast:
    """A live message whose JSON is written once, however many pages ask for it, and never when none does."""

    def __init__(self, message: LiveMessage) -> None:
        self.message = message

    @cached_property
    def text(self) -> str:
        """The message as JSON."""
        return _encoder.encode(self.message).decode()


class Relay:
    """Takes every tick; steps the game; spreads the result."""

    def __init__(self, therapy: Therapy, latency: LatencyMeter) -> None:
        self._therapy, self._latency = therapy, latency
        self.pages: FanOut[Broadcast] = FanOut()
        self.viewers: FanOut[LiveTick] = FanOut()

    def take(self, tick: LiveTick) -> None:
        """A tick came."""
        self._latency.commanded(tick)
        game = self._therapy.step(tick)
        if self.pages.readers:
            self.pages.put(Broadcast(LiveMessage(tick=tick, game=game, session=self._therapy.view())))
        self.viewers.put(tick)
