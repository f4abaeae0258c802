"""A folder of recordings, each read once."""

from __future__ import annotations

from fnmatch import fnmatch
from pathlib import Path

from fusion.errors import InputError
from fusion.recording.reader import read_recording
from fusion.recording.recording import Recording


class Shelf:
    """Recordings in one folder, read when they are first asked for.

    Raises:
        InputError: there is no such folder, or no recording in it.
    """

    def __init__(self, folder: Path) -> None:
        if not folder.is_dir():
            raise InputError(f"{folder} is no folder", "a folder with recordings in it", "mend --recordings")
        self._paths = {path.name: path for path in sorted(folder.iterdir()) if (path / "recording.json").is_file()}
        if not self._paths:
            raise InputError(
                f"{folder} holds no recording", "folders that each hold a recording.json", "mend --recordings"
            )
        self._read: dict[str, Recording] = {}

    def has(self, pattern: str) -> bool:
        """Whether any recording's name fits."""
        return any(fnmatch(name, pattern) for name in self._paths)

    def recordings(self, pattern: str) -> tuple[Recording, ...]:
        """Those whose name fits, by name."""
        return tuple(self._recording(name) for name in self._paths if fnmatch(name, pattern))

    def _recording(self, name: str) -> Recording:
        if name not in self._read:
            self._read[name] = read_recording(self._paths[name])
        return self._read[name]
