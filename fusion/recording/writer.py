"""Writes a recording in either form: the interchange folder, or the log."""

from __future__ import annotations

import csv
import gzip
import io
from collections.abc import Iterable, Iterator
from pathlib import Path

import msgspec

from fusion.errors import InputError, MachineError
from fusion.messages import Floats, SkeletonSample
from fusion.recording.folder import FORMAT, SKELETON_COLUMNS, TRUTH_COLUMNS
from fusion.recording.inertial import (
    ORIENTATION_TRUTH_COLUMNS,
    imu_block,
    imu_columns,
    imu_table,
    orientation_truth_table,
)
from fusion.recording.log import IMU, ORIENTATION_TRUTH, RANGES, LogAbout, LogWriter
from fusion.recording.ranges import RANGE_COLUMNS, range_block, range_entry, range_head, range_rows
from fusion.recording.recording import Recording, SkeletonStream, TruthStream
from fusion.skeleton import JOINTS

_ORIENTATION_TRUTH_FILE = "truth-orientation.csv.gz"


def write_recording(recording: Recording, path: Path) -> None:
    """Write a recording as a log where the name ends in `.mcap`, else as an interchange folder.

    The folder keeps tenths of a millimetre, microseconds and no receive times; the log keeps all.

    Raises:
        InputError: something of that name exists.
        MachineError: it cannot be written.
    """
    if path.exists():
        raise InputError(f"{path} exists", "a name that is free", "choose another, or remove it first")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        (_write_log if path.suffix == ".mcap" else _write_folder)(recording, path)
    except OSError as error:
        remedy = "choose another folder, or free some space"
        raise MachineError(f"cannot write {path} ({error.strerror})", "a folder to write to", remedy) from None


# ---------------------------------------------------------------- folder


def _write_folder(recording: Recording, folder: Path) -> None:
    folder.mkdir()
    names = [_file_name(stream.sensor, number) for number, stream in enumerate(recording.skeleton_streams)]
    for name, stream in zip(names, recording.skeleton_streams, strict=True):
        _write_table(folder / name, SKELETON_COLUMNS, _skeleton_rows(stream.samples))
    if recording.truth is not None:
        _write_table(folder / "truth.csv.gz", TRUTH_COLUMNS, _truth_rows(recording.truth))
    for stream_of_ranges, entry in zip(recording.range_streams, _range_entries(recording), strict=True):
        _write_table(folder / str(entry["file"]), RANGE_COLUMNS, range_rows(stream_of_ranges))
    _write_inertial(recording, folder)
    (folder / "recording.json").write_bytes(msgspec.json.format(msgspec.json.encode(_manifest(recording, names))))


def _file_name(sensor: str, number: int) -> str:
    plain = "".join(letter if letter.isalnum() or letter in "-_." else "-" for letter in sensor)
    return f"{number + 1}-{plain}.csv.gz"


def _range_entries(recording: Recording) -> list[dict[str, object]]:
    return [range_entry(s, f"ranges-{number + 1}.csv.gz") for number, s in enumerate(recording.range_streams)]


def _manifest(recording: Recording, names: list[str]) -> dict[str, object]:
    streams = [_stream_entry(name, s) for name, s in zip(names, recording.skeleton_streams, strict=True)]
    if recording.truth is not None:
        streams.append({"file": "truth.csv.gz", "kind": "truth", "clock": recording.truth.clock})
    streams += _range_entries(recording)
    streams += _inertial_entries(recording)
    manifest: dict[str, object] = {"format": FORMAT, "name": recording.name, "about": recording.about}
    if recording.origin:
        manifest["origin"] = recording.origin
    if recording.healthy_side:
        manifest["healthy_side"] = recording.healthy_side.value
    if recording.events:
        manifest["events"] = recording.events
    return manifest | {"streams": streams}


def _stream_entry(name: str, stream: SkeletonStream) -> dict[str, object]:
    return {
        "file": name,
        "kind": "skeleton",
        "sensor": stream.sensor,
        "skeleton": "kinect-v2",
        "primary": stream.primary,
        "clock": stream.clock,
    }


def _skeleton_rows(samples: Iterable[SkeletonSample]) -> Iterator[tuple[object, ...]]:
    written = set()
    for sample in samples:
        key = (f"{sample.t_s:.6f}", sample.body.replace(",", ";"))
        if key not in written:  # a straggler of a live frame may repeat its time; a folder must not
            written.add(key)
            yield from (key + row for row in _joint_rows(sample))


def _joint_rows(sample: SkeletonSample) -> Iterator[tuple[object, ...]]:
    points, states = sample.positions_in_sensor.tolist(), sample.state.tolist()
    for name, (x, y, z), state in zip(JOINTS, points, states, strict=True):
        if state:
            yield name, f"{x:.4f}", f"{y:.4f}", f"{z:.4f}", state


def _truth_rows(truth: TruthStream) -> Iterator[tuple[object, ...]]:
    for t_s, points in zip(truth.t_s.tolist(), truth.positions.tolist(), strict=True):
        for name, (x, y, z) in zip(truth.joints, points, strict=True):
            if x == x:  # NaN: no truth for this joint here
                yield f"{t_s:.6f}", name, f"{x:.4f}", f"{y:.4f}", f"{z:.4f}"


def _write_inertial(recording: Recording, folder: Path) -> None:
    for stream, entry in zip(recording.imu_streams, _inertial_entries(recording), strict=False):
        _write_table(folder / str(entry["file"]), imu_columns(stream), _number_rows(imu_table(stream)))
    if recording.orientation_truth is not None:
        rows = _number_rows(orientation_truth_table(recording.orientation_truth))
        _write_table(folder / _ORIENTATION_TRUTH_FILE, ORIENTATION_TRUTH_COLUMNS, rows)


def _inertial_entries(recording: Recording) -> list[dict[str, object]]:
    entries: list[dict[str, object]] = [
        {"file": f"imu-{_file_name(stream.site, number)}", "kind": "imu", "site": stream.site}
        for number, stream in enumerate(recording.imu_streams)
    ]
    if recording.orientation_truth is not None:
        entries.append({"file": _ORIENTATION_TRUTH_FILE, "kind": "truth-orientation"})
    return entries


def _number_rows(table: Floats) -> Iterator[tuple[object, ...]]:
    for row in table.tolist():
        yield tuple(f"{number:.6f}" for number in row)


def _write_table(path: Path, columns: tuple[str, ...], rows: Iterable[tuple[object, ...]]) -> None:
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(rows)
    path.write_bytes(gzip.compress(text.getvalue().encode(), mtime=0))


# ---------------------------------------------------------------- log


def _write_log(recording: Recording, path: Path) -> None:
    primary = next((stream.sensor for stream in recording.skeleton_streams if stream.primary), "")
    trouble = msgspec.json.encode(recording.events).decode()
    who = (recording.name, recording.about, recording.healthy_side, recording.origin, primary)
    about = LogAbout(*who, trouble, recording.arrivals_known)
    with LogWriter(path, about) as log:
        for sample in _in_time(recording.skeleton_streams):
            log.sample(sample)
        if recording.truth is not None:
            for t_s, points in zip(recording.truth.t_s.tolist(), recording.truth.positions, strict=True):
                log.truth(t_s, recording.truth.clock, recording.truth.joints, points)
        for stream in recording.imu_streams:
            log.numbers(IMU, stream.site, imu_block(stream))
        for number, ranges in enumerate(recording.range_streams):
            log.numbers(RANGES, range_head(ranges, number), range_block(ranges))
        if recording.orientation_truth is not None:
            log.numbers(ORIENTATION_TRUTH, "", orientation_truth_table(recording.orientation_truth))


def _in_time(streams: Iterable[SkeletonStream]) -> list[SkeletonSample]:
    return sorted((sample for stream in streams for sample in stream.samples), key=lambda sample: sample.t_received_s)
