"""One authority at a time (SR-11): which pages are connected, and which of them is in charge of the arm."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from fusion.errors import InputError, RefusedError
from server.api.live import AuthorityView, Screen

PAGE_NAME = r"^[A-Za-z0-9_-]{0,64}$"
LOST_AFTER_S = 1.0
"""A page acknowledges every tick that it gets; one that says nothing for so long is gone, whatever its socket says."""
SCREEN_LOST_AFTER_S = 3.0
"""The patient's screen may take longer: it moves nothing, and fetches and makes the next game's pictures in between."""


@dataclass(frozen=True, slots=True)
class Client:
    """A page of somebody who is logged in. Its name is no secret: the log-in is what is believed."""

    account_id: int
    account: str
    page: str
    """What the page calls itself, so that two browsers of one person are two; "" can be in charge of nothing."""

    def require_name(self) -> None:
        """Let only a page that can be told from others go on.

        Raises:
            InputError: it does not say what it calls itself.
        """
        if not self.page:
            raise InputError(
                "the page does not say which it is",
                "the header Mirrorlimb-Client with a name of the page's own, the same as at its stream's opening",
                "load the page again",
            )


class Connection:
    """A page's open stream."""

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self.replaced = asyncio.Event()
        """Set when the same page has opened a newer stream."""
        self._heard_s = clock()
        self._draws_for: Screen | None = None

    def heard(self, drawn_on: Screen | None) -> None:
        """The page has said something, and for whom it draws; None while nobody sees it."""
        self._heard_s = self._clock()
        self._draws_for = drawn_on or self._draws_for

    @property
    def lives(self) -> bool:
        """Whether the page was heard lately, and is not open anew."""
        return self._heard_within(LOST_AFTER_S)

    @property
    def shows_patient(self) -> bool:
        """Whether it is the patient's screen, and there."""
        return self._draws_for is Screen.PATIENT and self._heard_within(SCREEN_LOST_AFTER_S)

    def _heard_within(self, duration_s: float) -> bool:
        return not self.replaced.is_set() and self._clock() - self._heard_s <= duration_s


class Presence:
    """The pages that have a stream open.

    Args:
        on_change: called when one comes or goes.
        clock: monotonic.
    """

    def __init__(self, on_change: Callable[[], None], clock: Callable[[], float] = time.monotonic) -> None:
        self._on_change, self._clock = on_change, clock
        self._open: dict[Client, list[Connection]] = {}

    @contextmanager
    def connected(self, client: Client) -> Iterator[Connection]:
        """The page's stream, while the block lasts. It takes the place of an older one of the same name: a tab that
        was doubled, or a connection whose end has not been noticed.
        """
        connection, all_of_it = Connection(self._clock), self._open.setdefault(client, [])
        if client.page:
            for older in all_of_it:
                older.replaced.set()
        all_of_it.append(connection)
        self._on_change()
        try:
            yield connection
        finally:
            all_of_it.remove(connection)
            self._forget_unless_open(client)
            self._on_change()

    def is_there(self, client: Client) -> bool:
        """Whether the page is connected and was heard lately."""
        return any(connection.lives for connection in self._open.get(client, ()))

    @property
    def patient_screens(self) -> int:
        """How many pages show the games to the patient."""
        return sum(connection.shows_patient for all_of_it in self._open.values() for connection in all_of_it)

    def shows_patient(self, client: Client) -> bool:
        """Whether the page is the patient's screen."""
        return any(connection.shows_patient for connection in self._open.get(client, ()))

    def _forget_unless_open(self, client: Client) -> None:
        if not self._open.get(client):
            self._open.pop(client, None)


class Authority:
    """Who is in charge of the open session. A page that is lost keeps its place until another one takes it, and has it
    back as soon as it is connected again; meanwhile nobody is in charge.
    """

    def __init__(self, presence: Presence) -> None:
        self._presence = presence
        self._holder: Client | None = None

    @property
    def in_charge(self) -> str:
        """The account that is in charge and connected; "" = nobody, and an engaged arm holds."""
        return self._holder.account if self._holder is not None and self._is_connected else ""

    def view(self) -> AuthorityView | None:
        """Who is in charge, for people; None while no session is open."""
        holder = self._holder
        if holder is None:
            return None
        return AuthorityView(account=holder.account, client=holder.page, connected=self._is_connected)

    def give(self, client: Client) -> None:
        """Put that page in charge: it has opened the session."""
        self._holder = client

    def end(self) -> None:
        """The session is over."""
        self._holder = None

    def take(self, client: Client, confirmed: bool) -> None:
        """Put that page in charge in another's place.

        Raises:
            InputError: the page has no name.
            RefusedError: somebody is in charge and connected, and that has not been confirmed.
        """
        client.require_name()
        if self._is_connected and not confirmed and client != self._holder:
            raise RefusedError(
                f"{self._other(client)} is in charge now", "a confirmation", "confirm that you take over from them"
            )
        self._holder = client

    def require(self, client: Client) -> None:
        """Let only the page in charge go on.

        Raises:
            RefusedError: another page is in charge.
        """
        if client != self._holder:
            raise RefusedError(
                f"{self._other(client)} is in charge of the arm",
                "the page that opened the session or took it over; hold, stop and pain are for everybody",
                "take over first",
            )

    @property
    def _is_connected(self) -> bool:
        return self._holder is not None and self._presence.is_there(self._holder)

    def _other(self, client: Client) -> str:
        holder = self._holder
        if holder is None:
            return "nobody"
        return "another page of yours" if holder.account_id == client.account_id else holder.account
