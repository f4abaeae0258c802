"""Whose token it was a moment ago: a stop must not wait for a database that is busy, locked or gone (SR-7, SR-8)."""

from __future__ import annotations

import time
from collections.abc import Callable
from threading import Lock

from db.account import Account

LATELY_S = 10.0
"""The database is asked again after so long; open pages ask every five seconds, so theirs are always known."""
KEPT = 1000
"""Tokens remembered; beyond that, those that were longest not asked for are forgotten."""


class Recognised:
    """What the database last said of each token. Safe to use from several threads."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._lock = Lock()
        self._known: dict[str, tuple[Account, float]] = {}

    def note(self, token_hash: str, account: Account | None) -> None:
        """The database's answer; None ends what was known before."""
        with self._lock:
            self._known.pop(token_hash, None)
            if account is not None:
                self._known[token_hash] = (account, self._clock())
            while len(self._known) > KEPT:
                del self._known[next(iter(self._known))]

    def lately(self, token_hash: str) -> Account | None:
        """Whose it was a moment ago."""
        known = self._known.get(token_hash)
        return known[0] if known is not None and self._clock() - known[1] <= LATELY_S else None

    def ever(self, token_hash: str) -> Account | None:
        """Whose it was when the database last answered."""
        known = self._known.get(token_hash)
        return None if known is None else known[0]
