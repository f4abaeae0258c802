"""The range stream of a recording: its columns, read from a table and laid out for either form."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

import msgspec
import numpy as np

from fusion.errors import RecordingError
from fusion.messages import Floats
from fusion.recording.recording import RangeStream
from fusion.recording.table import read_table

RANGE_COLUMNS = ("t_s", "anchor", "tag", "range_m")


class RangeHead(msgspec.Struct, frozen=True):
    """What a log keeps of a range stream beside its numbers."""

    number: int
    anchors: dict[str, tuple[float, float, float]]
    tags: tuple[str, ...]


def read_ranges(path: Path, anchors: Mapping[str, tuple[float, float, float]], tags: tuple[str, ...]) -> RangeStream:
    """Read a range stream.

    Args:
        path: the CSV file.
        anchors: where each anchor stands, metres, z up.
        tags: the tags' names.

    Raises:
        RecordingError: no anchors or tags are named, or a line that cannot be used.
    """
    if not anchors or not tags:
        raise RecordingError(f"{path}: recording.json names no anchors or no tags", "both", "mend recording.json")
    table = read_table(path, RANGE_COLUMNS)
    t_s, range_m = table.numbers("t_s"), table.numbers("range_m")
    table.require(np.isfinite(t_s), lambda row: f"t_s is '{table.field('t_s', row)}'", "a time in seconds")
    good = np.isfinite(range_m) & (range_m >= 0)
    table.require(good, lambda row: f"range_m is '{table.field('range_m', row)}'", "a distance in metres")
    anchor = table.codes("anchor", {name: i for i, name in enumerate(anchors)}, f"one of {' '.join(anchors)}")
    tag = table.codes("tag", {name: i for i, name in enumerate(tags)}, f"one of {' '.join(tags)}")
    return _stream(anchors, tags, np.column_stack([t_s, anchor, tag, range_m]))


def _stream(anchors: Mapping[str, tuple[float, float, float]], tags: tuple[str, ...], table: Floats) -> RangeStream:
    in_order = table[np.argsort(table[:, 0], kind="stable")]
    positions = np.array(list(anchors.values()), dtype=np.float64)
    anchor, tag = in_order[:, 1].astype(np.int64), in_order[:, 2].astype(np.int64)
    return RangeStream(tuple(anchors), positions, tags, in_order[:, 0], anchor, tag, in_order[:, 3])


def _anchors(stream: RangeStream) -> dict[str, tuple[float, float, float]]:
    return {name: (x, y, z) for name, (x, y, z) in zip(stream.anchors, stream.anchor_positions.tolist(), strict=True)}


# ---------------------------------------------------------------- for the folder


def range_rows(stream: RangeStream) -> Iterator[tuple[object, ...]]:
    """The lines of a range stream, in the order of `RANGE_COLUMNS`."""
    values = (stream.t_s.tolist(), stream.anchor.tolist(), stream.tag.tolist(), stream.range_m.tolist())
    for t_s, anchor, tag, range_m in zip(*values, strict=True):
        yield f"{t_s:.6f}", stream.anchors[anchor], stream.tags[tag], f"{range_m:.4f}"


def range_entry(stream: RangeStream, file: str) -> dict[str, object]:
    """How `recording.json` lists a range stream."""
    return {"file": file, "kind": "range", "anchors": _anchors(stream), "tags": stream.tags}


# ---------------------------------------------------------------- for the log


def range_head(stream: RangeStream, number: int) -> str:
    """The stream's anchors and tags as JSON; `number` keeps streams apart."""
    return msgspec.json.encode(RangeHead(number, _anchors(stream), stream.tags)).decode()


def range_block(stream: RangeStream) -> Floats:
    """Time, anchor, tag and range, (R, 4)."""
    return np.column_stack([stream.t_s, stream.anchor, stream.tag, stream.range_m])


def ranges_from_block(head: str, block: Floats) -> RangeStream:
    """The inverse of `range_head` and `range_block`."""
    about = msgspec.json.decode(head, type=RangeHead)
    return _stream(about.anchors, about.tags, block)
