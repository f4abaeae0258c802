"""What may go wrong with the database, said so that a person can act on it.

DatabaseError
├── CannotOpenError    not a database, no permission, no such folder
├── TooNewError        written by a newer version of this program
└── NotStoredError     a write that the database refused; nothing of it was kept
"""

from __future__ import annotations


class DatabaseError(Exception):
    """Base of the database's errors.

    Args:
        what: what is wrong, naming the file.
        expected: what would have been right.
        remedy: what the person can do now.
    """

    def __init__(self, what: str, expected: str, remedy: str) -> None:
        self.what, self.expected, self.remedy = what, expected, remedy
        super().__init__(f"{what}. Expected: {expected}. Try: {remedy}.")


class CannotOpenError(DatabaseError):
    """The database cannot be opened."""


class TooNewError(DatabaseError):
    """The database was written by a newer version of this program."""


class NotStoredError(DatabaseError):
    """A write that the database refused."""
