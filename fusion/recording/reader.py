"""The one door to recordings: takes either form, so that every command does."""

from __future__ import annotations

from pathlib import Path

from fusion.errors import RecordingError
from fusion.recording.folder import read_folder
from fusion.recording.log_reader import read_log
from fusion.recording.recording import (
    ImuStream,
    OrientationTruth,
    RangeStream,
    Recording,
    SkeletonStream,
    Trouble,
    TruthStream,
)

__all__ = [
    "ImuStream",
    "OrientationTruth",
    "RangeStream",
    "Recording",
    "SkeletonStream",
    "Trouble",
    "TruthStream",
    "read_recording",
]


def read_recording(path: Path) -> Recording:
    """Read a recording.

    Args:
        path: an interchange folder, its `recording.json`, or a log (`.mcap`).

    Raises:
        RecordingError: names the file, the line where there is one, what was expected and what to do.
    """
    if not path.exists():
        raise RecordingError(f"{path} does not exist", "a recording's folder or .mcap file", "check the path")
    if path.is_dir():
        return read_folder(path)
    return read_folder(path.parent) if path.name == "recording.json" else read_log(path)
