"""What people want of the arm while a session is open, and who may want it (SR-11)."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress

from fusion.errors import RefusedError
from server.api.authority import Authority, Client
from server.api.course import Course
from server.api.forms import Action, Answer, AssistanceForm, AuthorityPublic, Follow, MeasuredRange
from server.api.journal import CONTROL, Journal
from server.api.measured_range import RangeMeter, moves_freely
from server.api.station_link import StationLink
from server.messages import (
    Enable,
    FollowBody,
    Hold,
    Pain,
    Reset,
    Resume,
    SetAssistance,
    Stop,
    Wish,
    WishAnswer,
)

FOR_EVERYBODY: tuple[Action, ...] = ("hold", "pain")
"""Like a stop, what makes the arm rest is never refused for lack of authority."""


class Controls:
    """Carries wishes to the station, from those who may have them.

    Args:
        opened: the open session of that number; refuses where it is not open.
        link: the station.
        journal: where everything is noted.
        authority: who is in charge.
    """

    def __init__(
        self, opened: Callable[[int], Course], link: StationLink, journal: Journal, authority: Authority
    ) -> None:
        self._opened, self._link, self._journal, self._authority = opened, link, journal, authority

    async def control(self, session_id: int, action: Action, client: Client) -> Answer:
        """Start, hold, resume, stop, reset, or say that it hurts. A stop goes through whatever session is open.

        Raises:
            RefusedError: the session is not open, another page is in charge, or the station refuses.
        """
        if action == "stop":
            return await self._stop(session_id, client)
        course = self._opened(session_id)
        if action not in FOR_EVERYBODY:
            self._authority.require(client)
        if course.interrupted:
            raise RefusedError(
                "the station was restarted during this session",
                "a session that the station has followed from its beginning",
                "end this session and open a new one",
            )
        answer = await self._link.ask(_wish_for(action, client.account))
        self._journal.note(session_id, CONTROL, action, by=client.account)
        return _answer(answer)

    async def _stop(self, session_id: int, client: Client) -> Answer:
        answer = await self._link.ask(lambda number: Stop(number=number, reason=f"{client.account} pressed stop"))
        with suppress(RefusedError):  # a page may name a session that is over; its stop is noted nowhere, but done
            self._opened(session_id)
            self._journal.note(session_id, CONTROL, "stop", by=client.account)
        return _answer(answer)

    async def help(self, session_id: int, form: AssistanceForm, client: Client) -> Answer:
        """Help in another way, or more, or less.

        Raises:
            RefusedError: not open, not in charge, more than the patient is allowed, or the station refuses.
        """
        course = self._opened(session_id)
        self._authority.require(client)
        check_level(form.level, course.opening.assist_level_most)
        answer = await self._link.ask(lambda number: SetAssistance(number=number, mode=form.mode, level=form.level))
        text = f"{form.mode}, at most {form.level:.2f}"
        self._journal.note(session_id, "assistance", text, mode=form.mode, level=form.level, by=client.account)
        return _answer(answer)

    async def follow(self, session_id: int, form: Follow, client: Client) -> Answer:
        """Say which body of a sensor is the patient.

        Raises:
            RefusedError: the session is not open, another page is in charge, or the station refuses.
        """
        self._opened(session_id)
        self._authority.require(client)
        answer = await self._link.ask(lambda number: FollowBody(number=number, sensor=form.sensor, body=form.body))
        self._journal.note(session_id, "follow", f"{form.sensor} body {form.body}", by=client.account)
        return _answer(answer)

    async def take(self, session_id: int, confirmed: bool, client: Client) -> AuthorityPublic | None:
        """Take over. A moving arm is held, so that whoever is in charge now lets it move again.

        Raises:
            RefusedError: the session is not open, or somebody is in charge and that has not been confirmed.
        """
        self._opened(session_id)
        before = self._authority.view()
        self._authority.take(client, confirmed)
        self._link.beat()
        text = f"{client.account} took over from {before.account if before else 'nobody'}"
        self._journal.note(session_id, "taken over", text, by=client.account)
        with suppress(RefusedError):  # most often it is at rest, and then there is nothing to hold
            await self._link.ask(lambda number: Hold(number=number, reason=f"{text}."))
        return self.authority()

    def authority(self) -> AuthorityPublic | None:
        """Who is in charge; None while no session is open."""
        view = self._authority.view()
        return None if view is None else AuthorityPublic.model_validate(view, from_attributes=True)

    def measure_range(self, session_id: int, client: Client) -> MeasuredRange:
        """Begin to measure how far the patient moves the arm unaided.

        Raises:
            RefusedError: the session is not open, another page is in charge, or the drive moves the arm.
        """
        course = self._opened(session_id)
        self._authority.require(client)
        tick = self._link.latest
        if tick is None or not moves_freely(tick):
            raise RefusedError(
                "the arm does not move freely now", "an engaged arm whose drive only carries its weight", "choose free"
            )
        course.meter = RangeMeter()
        return course.meter.read()

    def measured_range(self, session_id: int) -> MeasuredRange:
        """What has been measured since.

        Raises:
            RefusedError: the session is not open.
        """
        meter = self._opened(session_id).meter
        return MeasuredRange(ticks=0, range=None) if meter is None else meter.read()


def check_level(level: float, most: float) -> None:
    """Refuse more help than the patient is allowed.

    Raises:
        RefusedError: it is more.
    """
    if level > most:
        raise RefusedError(
            f"a level of {level:.2f} is more than the {most:.2f} that this patient is allowed",
            f"at most {most:.2f}",
            "choose less, or change the patient's limits and sign for them",
        )


def _answer(answer: WishAnswer) -> Answer:
    return Answer(state=answer.state, reason=answer.reason)


def _wish_for(action: Action, who: str) -> Callable[[int], Wish]:
    reason = f"{who} pressed {action}"
    makers: dict[str, Callable[[int], Wish]] = {
        "start": lambda number: Enable(number=number),
        "hold": lambda number: Hold(number=number, reason=reason),
        "resume": lambda number: Resume(number=number),
        "pain": lambda number: Pain(number=number, reason=reason),
        "reset": lambda number: Reset(number=number),
    }
    return makers[action]
