"""The one door to recordings: takes either form, so that every command does."""

from __future__ import annotations

from pathlib import Path

from fusion.errors import RecordingError
from fusion.recording.folder import read_folder
from fusion.recording.recording import OtherStream, Recording, SkeletonStream, Trouble, TruthStream

__all__ = ["OtherStream", "Recording", "SkeletonStream", "Trouble", "TruthStream", "read_recording"]


def read_recording(path: Path) -> Recording:
    """Read a recording.

    Args:
        path: an interchange folder, or its `recording.json`.

    Raises:
        RecordingError: names the file, the line where there is one, what was expected and what to do.
    """
    if not path.exists():
        raise RecordingError(f"{path} does not exist", "a recording's folder", "check the path")
    return read_folder(path if path.is_dir() else path.parent)
