"""A station whose clock is turned by hand: scripted datagrams and wishes go in, ticks come out; nothing is timed."""

from __future__ import annotations

from collections.abc import Callable
from itertools import count
from typing import Final, TypeVar, cast

import msgspec

from fusion.messages import Packet
from fusion.pipeline import PipelineSettings
from fusion.skeleton import Side
from server.channels import StationChannels
from server.config import StationConfig
from server.messages import AnyEvent, Heartbeat, LiveTick, Pain, Stop, Wish, WishAnswer
from server.station.demonstration import Demonstration
from server.station.exo.driver import Drive
from server.station.loop import Loop
from server.station.perception import Perception
from server.station.sources.source import Losses

DT_S: Final = 0.01
IN_CHARGE: Final = "therapist"
"""The account that holds authority while heartbeats are sent."""
Event = TypeVar("Event")
_decode = msgspec.msgpack.Decoder(AnyEvent).decode


class ScriptedSource:
    """A source that gives what somebody put into it."""

    losses = Losses()

    def __init__(self) -> None:
        self.ports = {"any": 0}
        self.waiting: list[Packet] = []

    def drain(self) -> list[Packet]:
        """What has arrived since the last call."""
        packets, self.waiting = self.waiting, []
        return packets


class ScriptedMailbox:
    """The station's channels, without sockets."""

    def __init__(self) -> None:
        self.wanted: list[Wish] = []
        self.told: list[AnyEvent] = []
        self.published = 0
        self.paused = False

    def stops(self) -> list[Wish]:
        """What comes on the stop channel."""
        return self._taken(lambda wish: isinstance(wish, Stop | Pain))

    def wishes(self) -> list[Wish]:
        """Everything else."""
        return self._taken(lambda wish: not isinstance(wish, Stop | Pain))

    def publish(self, tick: bytes) -> None:
        """A tick leaves."""
        self.published += 1

    def tell(self, event: bytes) -> None:
        """An event leaves."""
        self.told.append(_decode(event))

    def pause_demonstration(self, paused: bool) -> None:
        """The virtual patient is asked to be silent."""
        self.paused = paused

    def _taken(self, wanted: Callable[[Wish], bool]) -> list[Wish]:
        taken = [wish for wish in self.wanted if wanted(wish)]
        self.wanted = [wish for wish in self.wanted if not wanted(wish)]
        return taken


class CrankedStation:
    """A loop with its drive, and a service that beats.

    Args:
        config: of the station.
        drive: the exoskeleton, open.
        demonstration: in demonstration mode, who may be heard.
    """

    def __init__(self, config: StationConfig, drive: Drive, demonstration: Demonstration | None = None) -> None:
        self.source, self.mailbox = ScriptedSource(), ScriptedMailbox()
        self.now_s = 100.0
        self.beating, self.authority = True, IN_CHARGE
        self._numbers = count(1)
        perception = Perception(PipelineSettings(Side.LEFT, config.method, config.reference))
        channels = cast(StationChannels, self.mailbox)  # has the methods that the loop calls
        self.loop = Loop(config, self.source, perception, drive, channels, demonstration, lambda: self.now_s)

    def step(self) -> LiveTick:
        """The next tick."""
        self.now_s += DT_S
        if self.beating:
            self.mailbox.wanted.append(Heartbeat(number=0, authority=self.authority))
        return self.loop.step(self.now_s)

    def wish(self, make: Callable[..., Wish], **fields: object) -> int:
        """Wish for something in the next tick; the wish's number."""
        number = next(self._numbers)
        self.mailbox.wanted.append(make(number=number, **fields))
        return number

    def answer(self, number: int) -> WishAnswer:
        """What became of a wish, after its tick."""
        return next(answer for answer in self.told(WishAnswer) if answer.number == number)

    def told(self, kind: type[Event]) -> list[Event]:
        """Every event of a kind so far."""
        return [event for event in self.mailbox.told if isinstance(event, kind)]
