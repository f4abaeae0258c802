"""The live form of a recording: an append-only MCAP file that survives `kill -9` and can be read up to its last flush.

MCAP's default chunks of 1 MiB sit in memory until they are full and are lost with the process. Chunks of 32 KiB and a
`flush` a second lose a second at most. docs/formats.md says what the channels hold.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Final, Self

import msgspec
import numpy as np
from mcap.writer import CompressionType, Writer

from fusion.errors import MachineError
from fusion.messages import Floats, Packet, SkeletonSample, States
from fusion.skeleton import JOINT_COUNT, Side

LOG_FORMAT: Final = "mirrorlimb-log/1"
METADATA: Final = "mirrorlimb"
PACKETS, SAMPLES, TICKS, EVENTS, TRUTH = "packets", "samples", "ticks", "events", "truth"
IMU, ORIENTATION_TRUTH, RANGES = "imu", "truth-orientation", "range"
CHANNELS: Final = (PACKETS, SAMPLES, TICKS, EVENTS, TRUTH, IMU, ORIENTATION_TRUTH, RANGES)
_CHUNK_BYTES: Final = 32 * 1024
_NS_PER_S: Final = 1e9
_ROWS_AT_ONCE: Final = 256


@dataclass(frozen=True, slots=True)
class LogAbout:
    """What a log says of itself, written first."""

    name: str
    about: str = ""
    healthy_side: Side | None = None
    origin: str = ""
    primary: str = ""
    """Name of the reference sensor; "" where it was not known at the start."""
    trouble: str = "[]"
    """JSON list of the trouble that was put into a recording; empty for what was recorded live."""
    arrivals_known: bool = True
    """False for what was converted from a form that keeps no receive times."""


class PacketEntry(msgspec.Struct, frozen=True, array_like=True):
    """A datagram as the log keeps it."""

    stream: str
    t_received_s: float
    payload: bytes


class SampleEntry(msgspec.Struct, frozen=True, array_like=True):
    """A skeleton sample as the log keeps it: positions as little-endian float64, NaN where lost, states as bytes."""

    sensor: str
    body: str
    t_s: float
    t_received_s: float
    positions_in_sensor: bytes  # (J, 3) m
    state: bytes  # (J,)


class TruthEntry(msgspec.Struct, frozen=True, array_like=True):
    """One instant of truth; positions as in `SampleEntry`."""

    t_s: float
    clock: str
    joints: tuple[str, ...]  # (N,)
    positions: bytes  # (N, 3) m


class NumbersEntry(msgspec.Struct, frozen=True, array_like=True):
    """Some rows of a stream of numbers; the first column is the time."""

    name: str
    columns: int
    rows: bytes  # (rows, columns) little-endian float64


class LogWriter:
    """Writes a log; one writer, one thread. `flush` once a second: what comes after the last flush may be lost.

    Args:
        path: the file to make; it must not exist yet.
        about: what the log says of itself.

    Raises:
        MachineError: the file cannot be made. Later writes raise OSError (a full disk), which is the caller's to count.
    """

    def __init__(self, path: Path, about: LogAbout) -> None:
        try:
            self._file = path.open("xb")
        except OSError as error:
            remedy = "choose another name or folder, or free some space"
            raise MachineError(f"cannot write {path} ({error.strerror})", "a new file", remedy) from None
        self._writer = Writer(self._file, chunk_size=_CHUNK_BYTES, compression=CompressionType.LZ4)
        self._writer.start(profile=LOG_FORMAT)
        self._writer.add_metadata(METADATA, _as_metadata(about))
        self._channels = {topic: self._writer.register_channel(topic, "msgpack", 0) for topic in CHANNELS}
        self._encode = msgspec.msgpack.Encoder().encode
        self._file.flush()

    def packet(self, packet: Packet) -> None:
        """Keep a datagram as it came."""
        entry = PacketEntry(packet.stream, packet.t_received_s, packet.payload)
        self._add(PACKETS, self._encode(entry), packet.t_received_s)

    def sample(self, sample: SkeletonSample) -> None:
        """Keep a decoded sample."""
        entry = SampleEntry(
            sample.sensor,
            sample.body,
            sample.t_s,
            sample.t_received_s,
            sample.positions_in_sensor.astype("<f8").tobytes(),
            sample.state.tobytes(),
        )
        self._add(SAMPLES, self._encode(entry), sample.t_received_s)

    def truth(self, t_s: float, clock: str, joints: tuple[str, ...], positions: Floats) -> None:
        """Keep where things really were at one instant; for converted recordings."""
        entry = TruthEntry(t_s, clock, joints, positions.astype("<f8").tobytes())
        self._add(TRUTH, self._encode(entry), t_s)

    def numbers(self, topic: str, name: str, table: Floats) -> None:
        """Keep a stream of numbers (T, columns), time first; for converted recordings."""
        for start in range(0, len(table), _ROWS_AT_ONCE):
            rows = table[start : start + _ROWS_AT_ONCE]
            entry = NumbersEntry(name, table.shape[1], rows.astype("<f8").tobytes())
            self._add(topic, self._encode(entry), float(rows[0, 0]))

    def tick(self, tick: bytes, t_s: float) -> None:
        """Keep a tick, already encoded as msgpack."""
        self._add(TICKS, tick, t_s)

    def event(self, event: bytes, t_s: float) -> None:
        """Keep an event, already encoded as msgpack."""
        self._add(EVENTS, event, t_s)

    def _add(self, topic: str, data: bytes, t_s: float) -> None:
        time_ns = max(0, round(t_s * _NS_PER_S))  # MCAP knows no time before 0; the entries carry their own
        self._writer.add_message(self._channels[topic], time_ns, data, time_ns)

    def flush(self) -> None:
        """Hand everything so far to the operating system, whole chunks at a time."""
        self._writer.flush()  # type: ignore[no-untyped-call]  # mcap leaves this one untyped

    def close(self) -> None:
        """Write the index and close the file; twice does no harm."""
        if not self._file.closed:
            self._writer.finish()  # type: ignore[no-untyped-call]  # mcap leaves this one untyped
            self._file.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def _as_metadata(about: LogAbout) -> dict[str, str]:
    return {
        "format": LOG_FORMAT,
        "name": about.name,
        "about": about.about,
        "healthy_side": about.healthy_side.value if about.healthy_side else "",
        "origin": about.origin,
        "primary": about.primary,
        "trouble": about.trouble,
        "arrivals": "known" if about.arrivals_known else "",
    }


def about_from_metadata(metadata: dict[str, str]) -> LogAbout:
    """The inverse of what the writer put first; raises ValueError on a side that is none."""
    side = metadata.get("healthy_side", "")
    return LogAbout(
        name=metadata.get("name", ""),
        about=metadata.get("about", ""),
        healthy_side=Side(side) if side else None,
        origin=metadata.get("origin", ""),
        primary=metadata.get("primary", ""),
        trouble=metadata.get("trouble", "[]"),
        arrivals_known=metadata.get("arrivals", "known") == "known",
    )


def as_sample(entry: SampleEntry) -> SkeletonSample:
    """The sample that an entry keeps; raises ValueError if its arrays are of another size.

    Copies, as read-only arrays are of another kind: compiled loops would be compiled anew for them.
    """
    positions: Floats = np.frombuffer(entry.positions_in_sensor, dtype="<f8").reshape(JOINT_COUNT, 3).astype(np.float64)
    state: States = np.frombuffer(entry.state, dtype=np.uint8).reshape(JOINT_COUNT).copy()
    return SkeletonSample(entry.sensor, entry.body, entry.t_s, entry.t_received_s, positions, state)
