"""From datagrams to skeleton samples: one object for all senders and dialects. It never raises and stays small."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import Any, Final

from fusion.formats import osc
from fusion.formats.dialect import Assembler, Dialect
from fusion.formats.osc import BadDatagram, Message, Reason
from fusion.formats.registry import dialect_of_address
from fusion.messages import Packet, SkeletonSample

MAX_SENDERS: Final = 32
"""Pairs of sender and dialect, and sensors, that are kept at once."""
FORGET_AFTER_S: Final = 10.0
"""A sender silent for this long makes room for another when the table is full."""
MAX_UNKNOWN: Final = 20
_MAX_ADDRESS: Final = 80


@dataclass(frozen=True, slots=True)
class DecoderCounts:
    """What has come in since the start."""

    datagrams: int
    refused: tuple[tuple[Reason, int], ...]
    """Datagrams, or messages in a bundle, that were not used, by reason."""
    unknown_addresses: tuple[str, ...]
    """OSC addresses that no dialect claims; each once, the first 20."""

    @property
    def refused_in_all(self) -> int:
        """Refusals of all reasons together."""
        return sum(count for _, count in self.refused)


@dataclass(slots=True, eq=False)
class _Sender:
    assembler: Assembler
    dialect: str
    heard_s: float


@dataclass(slots=True, eq=False)
class Decoder:
    """Tells the dialect from the address and the sensor from the sender; bounded however many senders there are."""

    _senders: dict[tuple[str, str], _Sender] = field(default_factory=dict)
    _sensors: dict[str, _Sender] = field(default_factory=dict)
    _datagrams: int = 0
    _refused: Counter[Reason] = field(default_factory=Counter)
    _unknown: dict[str, None] = field(default_factory=dict)

    def feed(self, packet: Packet) -> tuple[SkeletonSample, ...]:
        """Take one datagram; returns the samples that it completes, in order."""
        self._datagrams += 1
        try:
            messages = osc.read(packet.payload)
        except BadDatagram as bad:
            self._refused[bad.reason] += 1
            return ()
        samples: list[SkeletonSample] = []
        senders: list[_Sender] = []
        for message in messages:
            self._take(message, packet, samples, senders)
        if osc.is_bundle(packet.payload):
            for sender in senders:
                self._give(sender, sender.assembler.end_of_bundle(), samples)
        return tuple(samples)

    def flush(self, now_s: float) -> tuple[SkeletonSample, ...]:
        """Close the frames that have been silent for 12 ms; call it once per tick."""
        samples: list[SkeletonSample] = []
        for sender in self._senders.values():
            self._give(sender, sender.assembler.flush(now_s), samples)
        return tuple(samples)

    def dialect_of(self, sensor: str) -> str:
        """Name of the dialect that a sensor speaks; "" for one that has not been heard."""
        sender = self._sensors.get(sensor)
        return sender.dialect if sender else ""

    def counts(self) -> DecoderCounts:
        """What has come in so far."""
        return DecoderCounts(self._datagrams, tuple(self._refused.items()), tuple(self._unknown))

    def _take(self, message: Message, packet: Packet, samples: list[SkeletonSample], senders: list[_Sender]) -> None:
        try:
            sender = self._sender(message.address, packet)
            if sender not in senders:
                senders.append(sender)
            self._give(sender, sender.assembler.flush(packet.t_received_s), samples)
            self._give(sender, sender.assembler.take(message, packet.t_received_s), samples)
        except BadDatagram as bad:
            self._refused[bad.reason] += 1

    def _sender(self, address: str, packet: Packet) -> _Sender:
        dialect = dialect_of_address(address)
        if dialect is None:
            self._note_unknown(address)
            raise BadDatagram(Reason.UNKNOWN_ADDRESS)
        sender = self._senders.get((packet.stream, dialect.name)) or self._welcome(dialect, packet)
        sender.heard_s = packet.t_received_s
        return sender

    def _welcome(self, dialect: Dialect, packet: Packet) -> _Sender:
        _make_room(self._senders, packet.t_received_s)
        sender = _Sender(dialect.assembler(packet.stream), dialect.name, packet.t_received_s)
        self._senders[packet.stream, dialect.name] = sender
        return sender

    def _give(self, sender: _Sender, done: list[SkeletonSample], samples: list[SkeletonSample]) -> None:
        for sample in done:
            try:
                if sample.sensor not in self._sensors:
                    _make_room(self._sensors, sample.t_received_s)
                self._sensors[sample.sensor] = sender
                samples.append(sample)
            except BadDatagram as bad:
                self._refused[bad.reason] += 1

    def _note_unknown(self, address: str) -> None:
        if len(self._unknown) < MAX_UNKNOWN:
            shown = "".join(letter if letter.isprintable() else "?" for letter in address[:_MAX_ADDRESS])
            self._unknown[shown] = None


def _make_room(table: dict[Any, _Sender], now_s: float) -> None:
    """Forget who has been silent for long; refuse a newcomer when all are busy."""
    if len(table) < MAX_SENDERS:
        return
    for key in [key for key, sender in table.items() if now_s - sender.heard_s > FORGET_AFTER_S]:
        del table[key]
    if len(table) >= MAX_SENDERS:
        raise BadDatagram(Reason.TOO_MANY_SENDERS)
