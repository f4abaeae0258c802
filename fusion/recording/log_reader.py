"""Reads a log, also one that was cut off anywhere: everything up to its last whole chunk."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Final, TypeVar

import msgspec
import numpy as np
from mcap.exceptions import McapError
from mcap.records import Channel, Footer, Message, Metadata
from mcap.stream_reader import StreamReader

from fusion.errors import RecordingError
from fusion.messages import Floats, Packet, SkeletonSample
from fusion.recording.folder import EventEntry
from fusion.recording.inertial import imu_from_block, orientation_truth_from_table
from fusion.recording.log import (
    EVENTS,
    IMU,
    LOG_FORMAT,
    METADATA,
    ORIENTATION_TRUTH,
    PACKETS,
    RANGES,
    SAMPLES,
    TICKS,
    TRUTH,
    LogAbout,
    NumbersEntry,
    PacketEntry,
    SampleEntry,
    TruthEntry,
    about_from_metadata,
    as_sample,
)
from fusion.recording.ranges import ranges_from_block
from fusion.recording.recording import OrientationTruth, Recording, SkeletonStream, Trouble, TruthStream

# What mcap, lz4 and struct raise on a record that is not whole.
_CUT_OFF: Final = (McapError, struct.error, ValueError, RuntimeError, EOFError, OverflowError, MemoryError)
_MAX_RECORD_BYTES: Final = 64 * 2**20
_Entry = TypeVar("_Entry")


@dataclass(frozen=True, slots=True)
class LogEntry:
    """One message of a log, as it stands."""

    topic: str
    t_s: float
    data: bytes


class LogReader:
    """A log that may have been cut off.

    Raises:
        RecordingError: the file cannot be opened or is no log of ours.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.about: LogAbout = self._read_about()

    def entries(self) -> Iterator[LogEntry]:
        """All messages in the order they were written, up to where the file is whole."""
        topics: dict[int, str] = {}
        for record in self._records():
            if isinstance(record, Channel):
                topics[record.id] = record.topic
            elif isinstance(record, Message) and record.channel_id in topics:
                yield LogEntry(topics[record.channel_id], record.log_time / 1e9, record.data)

    def is_whole(self) -> bool:
        """Whether the log was closed; False after a crash. Reads the file once."""
        return any(isinstance(record, Footer) for record in self._records())

    def packets(self) -> Iterator[Packet]:
        """The datagrams."""
        for entry in self._decoded(PACKETS, PacketEntry):
            yield Packet(entry.stream, entry.t_received_s, entry.payload)

    def samples(self) -> Iterator[SkeletonSample]:
        """The decoded samples."""
        for entry in self._decoded(SAMPLES, SampleEntry):
            try:
                yield as_sample(entry)
            except ValueError as error:
                raise self._broken(str(error)) from None

    def truth(self) -> Iterator[TruthEntry]:
        """The instants of truth of a converted recording."""
        yield from self._decoded(TRUTH, TruthEntry)

    def numbers(self, topic: str) -> dict[str, Floats]:
        """The streams of numbers of a topic by name, each (T, columns)."""
        entries: dict[str, list[NumbersEntry]] = {}
        for entry in self._decoded(topic, NumbersEntry):
            entries.setdefault(entry.name, []).append(entry)
        try:
            return {name: np.concatenate([_rows(entry) for entry in parts]) for name, parts in entries.items()}
        except ValueError as error:
            raise self._broken(f"{topic}: {error}") from None

    def ticks(self) -> Iterator[LogEntry]:
        """The station's ticks, still encoded."""
        return (entry for entry in self.entries() if entry.topic == TICKS)

    def events(self) -> Iterator[LogEntry]:
        """The station's events, still encoded."""
        return (entry for entry in self.entries() if entry.topic == EVENTS)

    def _decoded(self, topic: str, kind: type[_Entry]) -> Iterator[_Entry]:
        decode = msgspec.msgpack.Decoder(kind).decode
        for entry in self.entries():
            if entry.topic == topic:
                try:
                    yield decode(entry.data)
                except msgspec.DecodeError as error:
                    raise self._broken(f"{topic}: {error}") from None

    def _records(self) -> Iterator[object]:
        try:
            with self.path.open("rb") as file:
                yield from StreamReader(file, validate_crcs=True, record_size_limit=_MAX_RECORD_BYTES).records
        except OSError as error:
            raise RecordingError(f"{self.path} cannot be read ({error.strerror})", "a log", "check the path") from None
        except _CUT_OFF:
            return

    def _read_about(self) -> LogAbout:
        first = next((record for record in self._records() if isinstance(record, (Metadata, Message))), None)
        if not isinstance(first, Metadata) or first.name != METADATA or first.metadata.get("format") != LOG_FORMAT:
            remedy = "name a folder with recording.json or a .mcap file that mirrorlimb wrote"
            raise RecordingError(f"{self.path} is no recording of ours, or holds nothing yet", LOG_FORMAT, remedy)
        try:
            return about_from_metadata(first.metadata)
        except ValueError as error:
            raise self._broken(str(error)) from None

    def _broken(self, problem: str) -> RecordingError:
        return RecordingError(f"{self.path}: {problem}", f"a log of format {LOG_FORMAT}", "fetch the file again")


def read_log(path: Path) -> Recording:
    """Read a log as a recording: its decoded samples by sensor, and the truth if it was converted from a folder.

    Raises:
        RecordingError: the file is no log of ours or an entry in it cannot be read.
    """
    reader = LogReader(path)
    by_sensor: dict[str, list[SkeletonSample]] = {}
    for sample in reader.samples():
        by_sensor.setdefault(sample.sensor, []).append(sample)
    about = reader.about
    primary = about.primary if about.primary in by_sensor else next(iter(by_sensor), "")
    return Recording(
        name=about.name,
        about=about.about,
        healthy_side=about.healthy_side,
        skeleton_streams=tuple(_stream(sensor, samples, primary) for sensor, samples in by_sensor.items()),
        truth=_truth(reader),
        events=_trouble(reader),
        path=path,
        origin=about.origin,
        arrivals_known=about.arrivals_known,
        imu_streams=tuple(imu_from_block(site, block) for site, block in reader.numbers(IMU).items()),
        orientation_truth=_orientation_truth(reader),
        range_streams=tuple(ranges_from_block(head, block) for head, block in reader.numbers(RANGES).items()),
    )


def _stream(sensor: str, samples: list[SkeletonSample], primary: str) -> SkeletonStream:
    in_order = sorted(samples, key=lambda sample: (sample.t_s, sample.body))
    return SkeletonStream(sensor, sensor == primary, "sensor", tuple(in_order))


def _truth(reader: LogReader) -> TruthStream | None:
    entries = list(reader.truth())
    if not entries:
        return None
    joints = entries[0].joints
    flat = np.frombuffer(b"".join(entry.positions for entry in entries), dtype="<f8")
    if flat.size != len(entries) * len(joints) * 3:
        raise RecordingError(f"{reader.path}: truth of changing size", "the same joints throughout", "fetch it again")
    t_s = np.array([entry.t_s for entry in entries])
    return TruthStream(t_s, joints, flat.reshape(len(entries), len(joints), 3), entries[0].clock)


def _rows(entry: NumbersEntry) -> Floats:
    return np.frombuffer(entry.rows, dtype="<f8").reshape(-1, entry.columns)


def _orientation_truth(reader: LogReader) -> OrientationTruth | None:
    tables = list(reader.numbers(ORIENTATION_TRUTH).values())
    return orientation_truth_from_table(tables[0]) if tables else None


def _trouble(reader: LogReader) -> tuple[Trouble, ...]:
    try:
        events = msgspec.json.decode(reader.about.trouble, type=tuple[EventEntry, ...])
    except msgspec.DecodeError as error:
        raise RecordingError(f"{reader.path}: {error}", "a list of trouble", "fetch the file again") from None
    return tuple(Trouble(event.sensor, event.kind, event.from_s, event.to_s) for event in events)
