"""The interchange form of a recording: a folder with `recording.json` and one CSV per stream (read)."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import msgspec
import numpy as np

from fusion.errors import RecordingError
from fusion.messages import Floats, SkeletonSample, States
from fusion.recording.inertial import read_imu, read_orientation_truth, refuse_twins
from fusion.recording.ranges import read_ranges
from fusion.recording.recording import (
    ImuStream,
    OrientationTruth,
    Recording,
    SkeletonStream,
    Trouble,
    TruthStream,
)
from fusion.recording.table import Table, read_table
from fusion.skeleton import INDEX, JOINT_COUNT, Side

FORMAT = "mirrorlimb-recording/1"
KINDS = ("skeleton", "truth", "imu", "range", "truth-orientation")
SKELETON_COLUMNS = ("t_s", "body", "joint", "x_m", "y_m", "z_m", "state")
TRUTH_COLUMNS = ("t_s", "joint", "x_m", "y_m", "z_m")
_STATES = {"0": 0, "1": 1, "2": 2}


class StreamEntry(msgspec.Struct, frozen=True):
    """One stream as `recording.json` lists it."""

    file: str
    kind: str
    sensor: str = ""
    skeleton: str = "kinect-v2"
    primary: bool = False
    clock: str = "sensor"
    tags: tuple[str, ...] = ()
    anchors: dict[str, tuple[float, float, float]] = {}  # msgspec copies an empty default
    site: str = ""


class EventEntry(msgspec.Struct, frozen=True):
    """One event as `recording.json` lists it."""

    kind: str
    from_s: float
    to_s: float
    sensor: str = ""


class Manifest(msgspec.Struct, frozen=True):
    """`recording.json`."""

    format: str
    streams: tuple[StreamEntry, ...]
    name: str = ""
    about: str = ""
    origin: str = ""
    healthy_side: Side | None = None
    up: str = ""
    events: tuple[EventEntry, ...] = ()


def read_folder(folder: Path) -> Recording:
    """Read an interchange folder.

    Raises:
        RecordingError: a file, column, line or name that cannot be used; says which and what would have been right.
    """
    manifest = _read_manifest(folder / "recording.json")
    skeletons = _named(folder, [entry for entry in manifest.streams if entry.kind == "skeleton"])
    truths = [entry for entry in manifest.streams if entry.kind == "truth"]
    tags = [tag for entry in manifest.streams for tag in entry.tags]
    return Recording(
        name=manifest.name or folder.name,
        about=manifest.about,
        healthy_side=manifest.healthy_side,
        skeleton_streams=tuple(_read_skeletons(folder, entry) for entry in skeletons),
        truth=_read_truth(folder, truths[0], tags) if truths else None,
        events=tuple(Trouble(e.sensor, e.kind, e.from_s, e.to_s) for e in manifest.events),
        path=folder,
        origin=manifest.origin,
        imu_streams=_read_imus(folder, manifest),
        orientation_truth=_read_orientation_truth(folder, manifest),
        range_streams=tuple(
            read_ranges(folder / entry.file, entry.anchors, entry.tags)
            for entry in manifest.streams
            if entry.kind == "range"
        ),
    )


# ---------------------------------------------------------------- recording.json


def _read_manifest(path: Path) -> Manifest:
    try:
        manifest = msgspec.json.decode(path.read_bytes(), type=Manifest)
    except OSError as error:
        remedy = "name a recording's folder or a .mcap file"
        raise RecordingError(f"{path} cannot be read ({error.strerror})", "a recording", remedy) from None
    except msgspec.DecodeError as error:
        raise RecordingError(f"{path}: {error}", f"a manifest of format '{FORMAT}'", "mend the file") from None
    if manifest.up not in ("", "z") and any(entry.kind == "range" for entry in manifest.streams):
        raise RecordingError(f"{path}: up is '{manifest.up}'", "z up beside a range stream", "turn the anchors' frame")
    if manifest.format != FORMAT:
        raise RecordingError(f"{path}: format is '{manifest.format}'", f"'{FORMAT}'", "convert the recording")
    _check_streams(path, manifest.streams)
    return manifest


def _check_streams(path: Path, streams: Sequence[StreamEntry]) -> None:
    if not streams:
        raise RecordingError(f"{path} lists no streams", "at least one", "fetch the recording again")
    for entry in streams:
        if entry.kind not in KINDS:
            raise RecordingError(f"{path}: stream kind '{entry.kind}' is unknown", ", ".join(KINDS), "mend the file")
        if Path(entry.file).name != entry.file:
            raise RecordingError(f"{path}: file '{entry.file}'", "a file beside recording.json", "mend the file")
        if entry.kind == "skeleton" and entry.skeleton != "kinect-v2":
            raise RecordingError(f"{path}: skeleton '{entry.skeleton}' is unknown", "kinect-v2", "mend the file")


def _named(folder: Path, entries: list[StreamEntry]) -> list[StreamEntry]:
    """Give every skeleton stream a sensor name of its own and make exactly one of them primary."""
    named = [msgspec.structs.replace(entry, sensor=entry.sensor or entry.file.split(".")[0]) for entry in entries]
    if len({entry.sensor for entry in named}) < len(named):
        path = folder / "recording.json"
        raise RecordingError(f"{path}: two skeleton streams name the same sensor", "one each", "mend the file")
    primary = next((i for i, entry in enumerate(named) if entry.primary), 0)
    return [msgspec.structs.replace(entry, primary=i == primary) for i, entry in enumerate(named)]


# ---------------------------------------------------------------- skeleton streams


def _read_skeletons(folder: Path, entry: StreamEntry) -> SkeletonStream:
    table = read_table(folder / entry.file, SKELETON_COLUMNS)
    return SkeletonStream(entry.sensor, entry.primary, entry.clock, _samples(table, entry.sensor))


def _samples(table: Table, sensor: str) -> tuple[SkeletonSample, ...]:
    t_s = _times(table)
    joint = table.codes("joint", INDEX, f"one of the joint names of Kinect v2: {' '.join(INDEX)}")
    state = table.codes("state", _STATES, "0 (lost), 1 (inferred) or 2 (tracked)")
    points = _points(table, state == 0)
    names, body = table.names("body")
    frame_t_s, frame_body, frame = _frames(t_s, body)
    _refuse_repeats(table, frame * JOINT_COUNT + joint)
    positions = np.full((len(frame_t_s), JOINT_COUNT, 3), np.nan)
    states: States = np.zeros((len(frame_t_s), JOINT_COUNT), dtype=np.uint8)
    positions[frame, joint], states[frame, joint] = points, state
    return tuple(
        SkeletonSample(sensor, names[b], t, t, positions[i], states[i])
        for i, (t, b) in enumerate(zip(frame_t_s.tolist(), frame_body.tolist(), strict=True))
    )


def _times(table: Table) -> Floats:
    t_s = table.numbers("t_s")
    table.require(np.isfinite(t_s), lambda row: f"t_s is '{table.field('t_s', row)}'", "a time in seconds")
    return t_s


def _points(table: Table, meaningless: np.ndarray) -> Floats:  # (rows, 3)
    points = np.stack([table.numbers(column) for column in ("x_m", "y_m", "z_m")], axis=-1)
    finite = np.isfinite(points).all(axis=-1)
    table.require(finite | meaningless, lambda _: "the position is not finite", "x_m, y_m, z_m in metres, or state 0")
    points[meaningless] = np.nan
    return points


def _frames(t_s: Floats, body: np.ndarray) -> tuple[Floats, np.ndarray, np.ndarray]:
    """Group rows by (time, body): each frame's time and body in order of time, and each row's frame."""
    if not len(t_s):
        return t_s, body, body
    order = np.lexsort((body, t_s))
    starts = np.ones(len(order), dtype=bool)
    starts[1:] = (np.diff(t_s[order]) != 0) | (np.diff(body[order]) != 0)
    frame = np.empty(len(order), dtype=np.int64)
    frame[order] = np.cumsum(starts) - 1
    return t_s[order][starts], body[order][starts], frame


def _refuse_repeats(table: Table, key: np.ndarray) -> None:
    """Refuse the first row whose `key`, from 0 on, was there before."""
    if (np.bincount(key) > 1).any():
        _, first = np.unique(key, return_index=True)
        alone = np.zeros(len(key), dtype=bool)
        alone[first] = True
        table.require(alone, lambda _: "this joint is there twice", "one row per t_s, body and joint")


# ---------------------------------------------------------------- truth


def _read_truth(folder: Path, entry: StreamEntry, tags: list[str]) -> TruthStream:
    table = read_table(folder / entry.file, TRUTH_COLUMNS)
    known = {name: i for i, name in enumerate([*INDEX, *tags])}
    joint = table.codes("joint", known, "a joint name of Kinect v2, or a tag that recording.json names")
    t_s, row = np.unique(_times(table), return_inverse=True)
    present, column = np.unique(joint, return_inverse=True)
    positions = np.full((len(t_s), len(present), 3), np.nan)
    # Only skeleton rows must be unique; real optical truth repeats some, and the last one counts.
    positions[row, column] = _points(table, np.zeros(len(row), dtype=bool))
    names = list(known)
    return TruthStream(t_s, tuple(names[i] for i in present), positions, entry.clock)


# ---------------------------------------------------------------- inertial sensors


def _read_imus(folder: Path, manifest: Manifest) -> tuple[ImuStream, ...]:
    entries = [entry for entry in manifest.streams if entry.kind == "imu"]
    refuse_twins(folder / "recording.json", [entry.site for entry in entries])
    return tuple(read_imu(folder / entry.file, entry.site) for entry in entries)


def _read_orientation_truth(folder: Path, manifest: Manifest) -> OrientationTruth | None:
    entries = [entry for entry in manifest.streams if entry.kind == "truth-orientation"]
    return read_orientation_truth(folder / entries[0].file) if entries else None
