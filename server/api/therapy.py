"""A therapy session from patient to saved metrics: opened, controlled, ended; one at a time."""

from __future__ import annotations

import asyncio
import secrets
import time
from contextlib import suppress
from datetime import datetime
from pathlib import Path

from fastapi.concurrency import run_in_threadpool

from db.columns import now_utc
from db.database import Database
from db.errors import DatabaseError
from db.patient import Patient
from db.therapy_session import SessionDetail, SessionPublic, SessionStatus, TherapySession
from db.workspace import SessionWorkspace
from fusion.errors import RefusedError
from fusion.skeleton import Side
from games.game import GameView
from server.api import session_store
from server.api.authority import Authority, Client
from server.api.controls import check_level
from server.api.course import Course, Opening
from server.api.demo_goal import goal
from server.api.figures import Figures
from server.api.forms import SessionOpen
from server.api.game_log import game_log_of
from server.api.game_room import GameRoom
from server.api.journal import Journal
from server.api.limits import session_limits
from server.api.live import SessionView
from server.api.station_link import StationLink
from server.api.workspace import inside
from server.config import Config
from server.messages import (
    AnyEvent,
    Assistance,
    CloseSession,
    JointLimits,
    LiveTick,
    OpenSession,
    SessionClosed,
)

CLOSED_WITHIN_S = 15.0
"""Ramp to rest, last flush of the recording; then we go on without waiting."""


class Therapy:
    """The session that is going on, if there is one.

    Args:
        config: the service's configuration.
        data: the data folder.
        database: where sessions are kept.
        link: the station.
        journal: where events go.
        figures: worked out at the end.
        authority: given to whoever opens a session.
        room: plays the games.
    """

    def __init__(
        self,
        config: Config,
        data: Path,
        database: Database,
        link: StationLink,
        journal: Journal,
        figures: Figures,
        authority: Authority,
        room: GameRoom,
    ) -> None:
        self._config, self._data, self._figures, self._authority, self._room = config, data, figures, authority, room
        self._database, self._link, self._journal = database, link, journal
        self._was_in_charge = ""
        self._course: Course | None = None
        self._turn = asyncio.Lock()
        self._closed = asyncio.Event()
        link.on_event.append(self._take_event)
        link.on_death.append(self._station_died)

    @property
    def is_open(self) -> bool:
        """Whether a session is going on."""
        return self._course is not None

    def step(self, tick: LiveTick) -> GameView | None:
        """Take a tick: step the game, steer the demonstration's patient."""
        course = self._course
        if course is not None:
            self._room.step(course, tick)
        if self._config.demo:
            self._link.steer_demonstration(goal(course, tick))
        return None if course is None else course.picture

    def view(self) -> SessionView | None:
        """The open session in a line."""
        return None if self._course is None else self._course.view(self._authority.view())

    def in_charge(self) -> str:
        """The account that is in charge and connected, "" = nobody; asked at every heartbeat, noted when it changes."""
        name, before = self._authority.in_charge, self._was_in_charge
        if name != before and self._course is not None:
            text = f"{name} is in charge" if name else f"{before} is not connected; nobody is in charge"
            self._journal.note(self._course.opening.id, "authority", text, before=before, after=name)
        self._was_in_charge = name
        return name

    async def current(self) -> SessionPublic | None:
        """The open session, or None."""
        course = self._course
        if course is None:
            return None
        return await run_in_threadpool(session_store.public, self._database, course.opening.id)

    async def open(self, form: SessionOpen, client: Client) -> SessionPublic:
        """Open a session; the page that does is in charge of it.

        Raises:
            InputError: the page has no name, or there is no such game.
            RefusedError: one is open, the side is not confirmed, nobody has signed for the limits, no movement is
                possible, the station refuses.
            ApiError: there is no such patient.
        """
        client.require_name()
        async with self._turn:
            if self._course is not None:
                raise RefusedError("a session is open already", "one session at a time", "end that session first")
            patient = await run_in_threadpool(session_store.existing_patient, self._database, form.patient_id)
            _check_side(form, patient)
            _check_limits(form, patient)
            limits = session_limits(patient.limits, self._config.station.device)
            begun = await run_in_threadpool(self._begin, form, patient, client, limits)
            await self._open_at_station(begun, patient, limits)
            self._course = Course(self._opening(begun, patient, limits))
            self._journal.note(begun.id or 0, "opened", f"opened by {client.account}", by=client.account)
            self._authority.give(client)
            self._link.beat()
            return await run_in_threadpool(session_store.public, self._database, begun.id or 0)

    async def end(self, session_id: int, pain_after: int | None, client: Client) -> SessionDetail:
        """End the session and store what it measured.

        Where the database refuses, the session stays open so that it can be ended again; nothing of it is lost.

        Raises:
            RefusedError: the session is not open, or another page is in charge.
            DatabaseError: it could not be stored.
        """
        async with self._turn:
            course = self.opened(session_id)
            self._authority.require(client)
            course.saving = True
            try:
                await self._close_at_station(course, client)
                await self._store_end(course, pain_after)
            except DatabaseError:
                course.saving = False
                raise
            self._course = None
            self._authority.end()
            await self._journal.written()
            await self._figures.measure(session_id, course.trials)
            return await run_in_threadpool(session_store.detail, self._database, session_id)

    def _begin(
        self, form: SessionOpen, patient: Patient, client: Client, limits: tuple[JointLimits, ...]
    ) -> TherapySession:
        """Store the session; opening it at the station follows."""
        allowed = inside(limits, self._config.station.gate.soft_margin_rad)
        return session_store.begin(
            self._database, form, patient, client.account_id, secrets.randbits(31), limits, allowed
        )

    async def _open_at_station(self, begun: TherapySession, patient: Patient, limits: tuple[JointLimits, ...]) -> None:
        recording = self._data / begun.recording
        recording.parent.mkdir(parents=True, exist_ok=True)
        try:
            await self._link.ask(
                lambda number: OpenSession(
                    number=number,
                    session=str(begun.id),
                    patient=patient.name,
                    healthy_side=Side(patient.healthy_side),
                    side_confirmed=True,
                    limits=limits,
                    limits_set_by=patient.limits_set_by,
                    recording=str(recording),
                    assistance=Assistance(begun.assistance),
                    level=begun.assist_level,
                )
            )
        except RefusedError:
            # An answer that came too late, now or at the last session's end, must not leave one open over there.
            with suppress(RefusedError):
                await self._link.ask(lambda number: CloseSession(number=number))
            await run_in_threadpool(session_store.forget, self._database, begun.id or 0)
            raise

    def _opening(self, begun: TherapySession, patient: Patient, limits: tuple[JointLimits, ...]) -> Opening:
        allowed = inside(limits, self._config.station.gate.soft_margin_rad)
        return Opening(
            id=begun.id or 0,
            patient=patient.name,
            affected_side=Side(begun.affected_side),
            exercises=begun.exercises,
            seed=begun.seed,
            limits=limits,
            assist_level_most=patient.assist_level_most,
            allowed=allowed,
            workspace=begun.workspace or SessionWorkspace(source="limits", used=allowed),
            game_log=game_log_of(self._data / begun.recording),
            started=begun.started_at,
            t_started_s=time.monotonic(),
        )

    async def _close_at_station(self, course: Course, client: Client) -> None:
        if course.closed:
            return
        self._closed.clear()
        try:
            if not course.interrupted:
                await self._link.ask(lambda number: CloseSession(number=number))
                await asyncio.wait_for(self._closed.wait(), CLOSED_WITHIN_S)
        except (RefusedError, TimeoutError) as error:
            self._journal.note(course.opening.id, "not closed", f"the station did not close the session: {error}")
        course.closed = True
        self._journal.note(course.opening.id, "ended", f"ended by {client.account}", by=client.account)

    async def _store_end(self, course: Course, pain_after: int | None) -> None:
        status = SessionStatus.INTERRUPTED if course.interrupted else SessionStatus.ENDED
        ended_at: datetime = now_utc()
        session_id = course.opening.id
        await self._room.close(course)
        await run_in_threadpool(session_store.store_played, self._database, session_id, course.played)
        await run_in_threadpool(session_store.finish, self._database, session_id, status, ended_at, pain_after)

    async def close(self) -> None:
        """The service ends: whatever was played so far is written down."""
        if self._course is not None:
            await self._room.close(self._course)

    def opened(self, session_id: int) -> Course:
        """The open session.

        Raises:
            RefusedError: that session is not open.
        """
        course = self._course
        if course is None or course.opening.id != session_id:
            raise RefusedError(f"session {session_id} is not open", "the open session", "open a session first")
        return course

    def _take_event(self, event: AnyEvent) -> None:
        if isinstance(event, SessionClosed):
            self._closed.set()
        if self._course is not None:
            self._journal.note_event(self._course.opening.id, event)

    def _station_died(self, words: str) -> None:
        self._closed.set()
        if self._course is not None:
            self._course.interrupted = True
            self._journal.note(self._course.opening.id, "interrupted", f"the station died: {words}")


def _check_limits(form: SessionOpen, patient: Patient) -> None:
    if not patient.limits_set_by:
        raise RefusedError(
            f"nobody has signed for {patient.name}'s limits",
            "limits that a therapist has confirmed as they are now",
            "look at the limits on the patient's page and confirm them",
        )
    if form.assist_level is not None:
        check_level(form.assist_level, patient.assist_level_most)


def _check_side(form: SessionOpen, patient: Patient) -> None:
    affected = Side(patient.healthy_side).other
    if form.confirmed_affected_side != affected:
        raise RefusedError(
            f"{patient.name}'s affected side is the {affected}, not the {form.confirmed_affected_side}",
            "the side that the patient's page names",
            "look which arm is in the exoskeleton; correct the patient's healthy side if that is wrong",
        )
