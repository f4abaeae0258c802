"""The errors a person may meet, each saying what was wrong, what was expected and what to do.

MirrorlimbError
├── InputError         a file, line or option that cannot be used (commands exit with 2)
│   └── RecordingError     a recording's folder, file or line
├── MachineError       something this machine lacks or refuses: a port, a browser, a folder
└── RefusedError       a wish that safety or the session's state does not allow now
"""

from __future__ import annotations


class MirrorlimbError(Exception):
    """Base of every error that is shown to a person.

    Args:
        what: what is wrong, naming the thing ("recording.json of 'x' has no streams").
        expected: what would have been right.
        remedy: what the person can do now.
    """

    def __init__(self, what: str, expected: str = "", remedy: str = "") -> None:
        self.what, self.expected, self.remedy = what, expected, remedy
        super().__init__(". ".join(part.rstrip(".") for part in self._parts()) + ".")

    def _parts(self) -> list[str]:
        parts = [self.what]
        if self.expected:
            parts.append(f"Expected: {self.expected}")
        if self.remedy:
            parts.append(f"Try: {self.remedy}")
        return parts


class InputError(MirrorlimbError):
    """A file, line, option or value that cannot be used."""


class RecordingError(InputError):
    """A recording that cannot be read; names the file and, where there is one, the line."""


class MachineError(MirrorlimbError):
    """Something that the machine must provide and does not: a port, a folder, a program."""


class RefusedError(MirrorlimbError):
    """A wish that safety or the session's state does not allow now."""
