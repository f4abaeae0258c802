"""A therapy session from patient to saved metrics: opened, controlled, ended; one at a time."""

from __future__ import annotations

import asyncio
import logging
import secrets
import time
from collections.abc import Callable
from contextlib import suppress
from datetime import datetime
from pathlib import Path

from fastapi.concurrency import run_in_threadpool

from db.account import Account
from db.columns import now_utc
from db.database import Database
from db.errors import DatabaseError
from db.patient import Patient
from db.therapy_session import SessionDetail, SessionPublic, SessionStatus, TherapySession
from fusion.errors import InputError, MirrorlimbError, RefusedError
from fusion.skeleton import Side
from games.catalogue import GAMES
from games.game import GameView
from server.api import session_store
from server.api.course import Course, Plan, counted, goal
from server.api.forms import Action, Answer, Curves, Follow, SessionOpen
from server.api.journal import Journal
from server.api.limits import session_limits
from server.api.live import SessionView
from server.api.measure import measure, read_curves
from server.api.station_link import StationLink
from server.config import Config
from server.messages import (
    AnyEvent,
    CloseSession,
    Enable,
    FollowBody,
    Hold,
    JointLimits,
    LiveTick,
    OpenSession,
    Reset,
    Resume,
    SessionClosed,
    Stop,
    Wish,
)

log = logging.getLogger(__name__)

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
    """

    def __init__(self, config: Config, data: Path, database: Database, link: StationLink, journal: Journal) -> None:
        self._config, self._data = config, data
        self._database, self._link, self._journal = database, link, journal
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
            before, after = course.picture, course.step(tick)
            if after is not None and counted(after) != counted(before):
                self._journal.note_score(course.plan.id, after)
        if self._config.demo:
            self._link.steer_demonstration(goal(course, tick))
        return None if course is None else course.picture

    def view(self) -> SessionView | None:
        """The open session in a line."""
        return None if self._course is None else self._course.view()

    async def current(self) -> SessionPublic | None:
        """The open session, or None."""
        course = self._course
        if course is None:
            return None
        return await run_in_threadpool(session_store.public, self._database, course.plan.id)

    async def open(self, form: SessionOpen, account: Account) -> SessionPublic:
        """Open a session.

        Raises:
            RefusedError: one is open, the side is not confirmed, no movement is possible, the station refuses.
            ApiError: there is no such patient.
        """
        async with self._turn:
            if self._course is not None:
                raise RefusedError("a session is open already", "one session at a time", "end that session first")
            _check_game(form.game)
            patient = await run_in_threadpool(session_store.existing_patient, self._database, form.patient_id)
            _check_side(form, patient)
            limits = session_limits(patient.passive_range, self._config.station.device)
            begun = await run_in_threadpool(
                session_store.begin, self._database, form, account, secrets.randbits(31), limits
            )
            await self._open_at_station(begun, patient, limits, account)
            self._course = Course(self._plan(begun, patient, limits))
            self._journal.note(begun.id or 0, "opened", f"opened by {account.name}", by=account.name)
            return await run_in_threadpool(session_store.public, self._database, begun.id or 0)

    async def control(self, session_id: int, action: Action, account: Account) -> Answer:
        """Do what a person wants of the arm.

        Raises:
            RefusedError: the session is not open, or the station refuses.
        """
        course = self._opened(session_id)
        if course.interrupted and action != "stop":
            raise RefusedError(
                "the station was restarted during this session",
                "a session that the station has followed from its beginning",
                "end this session and open a new one",
            )
        answer = await self._link.ask(_wish_for(action, account.name))
        self._journal.note(session_id, "control", action, by=account.name)
        return Answer(state=answer.state, reason=answer.reason)

    async def follow(self, session_id: int, form: Follow, account: Account) -> Answer:
        """Say which body of a sensor is the patient.

        Raises:
            RefusedError: the session is not open, or the station refuses.
        """
        self._opened(session_id)
        answer = await self._link.ask(lambda number: FollowBody(number=number, sensor=form.sensor, body=form.body))
        self._journal.note(session_id, "follow", f"{form.sensor} body {form.body}", by=account.name)
        return Answer(state=answer.state, reason=answer.reason)

    async def end(self, session_id: int, pain_after: int | None, account: Account) -> SessionDetail:
        """End the session and store what it measured.

        Where the database refuses, the session stays open so that it can be ended again; nothing of it is lost.

        Raises:
            RefusedError: the session is not open.
            DatabaseError: it could not be stored.
        """
        async with self._turn:
            course = self._opened(session_id)
            course.saving = True
            try:
                await self._close_at_station(course, account)
                await self._store_end(course, pain_after)
            except DatabaseError:
                course.saving = False
                raise
            self._course = None
            await self._journal.written()
            await self.measure(session_id)
            return await run_in_threadpool(session_store.detail, self._database, session_id)

    async def measure(self, session_id: int) -> None:
        """Store what a session's recording says was measured; what fails is tried again at the next start."""
        try:
            await run_in_threadpool(self._measure_now, session_id)
        except Exception as error:  # whatever it is, the session is over and must read so
            expected = isinstance(error, MirrorlimbError | DatabaseError | OSError)
            log.warning("session %d could not be measured: %s", session_id, error, exc_info=not expected)
            self._journal.note(session_id, "not measured", str(error))

    async def curves(self, session_id: int) -> Curves:
        """A session's curves, from its recording.

        Raises:
            ApiError: there is no such session.
            RecordingError: its recording cannot be read.
        """
        found = await run_in_threadpool(session_store.existing_session, self._database, session_id)
        over = self._course is None or self._course.plan.id != session_id
        return await run_in_threadpool(read_curves, self._data / found.recording, over)

    def _measure_now(self, session_id: int) -> None:
        found = session_store.existing_session(self._database, session_id)
        score = session_store.last_score(self._database, session_id)
        metrics = measure(self._data / found.recording, Side(found.affected_side).other, score)
        session_store.store_metrics(self._database, session_id, metrics)

    async def _open_at_station(
        self, begun: TherapySession, patient: Patient, limits: tuple[JointLimits, ...], account: Account
    ) -> None:
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
                    limits_set_by=account.name,
                    recording=str(recording),
                )
            )
        except RefusedError:
            # An answer that came too late, now or at the last session's end, must not leave one open over there.
            with suppress(RefusedError):
                await self._link.ask(lambda number: CloseSession(number=number))
            await run_in_threadpool(session_store.forget, self._database, begun.id or 0)
            raise

    def _plan(self, begun: TherapySession, patient: Patient, limits: tuple[JointLimits, ...]) -> Plan:
        return Plan(
            id=begun.id or 0,
            patient=patient.name,
            affected_side=Side(begun.affected_side),
            game=begun.game,
            seed=begun.seed,
            level=begun.level,
            limits=limits,
            soft_margin_rad=self._config.station.gate.soft_margin_rad,
            started=begun.started_at,
            t_started_s=time.monotonic(),
        )

    async def _close_at_station(self, course: Course, account: Account) -> None:
        if course.closed:
            return
        self._closed.clear()
        try:
            if not course.interrupted:
                await self._link.ask(lambda number: CloseSession(number=number))
                await asyncio.wait_for(self._closed.wait(), CLOSED_WITHIN_S)
        except (RefusedError, TimeoutError) as error:
            self._journal.note(course.plan.id, "not closed", f"the station did not close the session: {error}")
        course.closed = True
        self._journal.note(course.plan.id, "ended", f"ended by {account.name}", by=account.name)

    async def _store_end(self, course: Course, pain_after: int | None) -> None:
        status = SessionStatus.INTERRUPTED if course.interrupted else SessionStatus.ENDED
        ended_at: datetime = now_utc()
        await run_in_threadpool(session_store.finish, self._database, course.plan.id, status, ended_at, pain_after)

    def _opened(self, session_id: int) -> Course:
        course = self._course
        if course is None or course.plan.id != session_id:
            raise RefusedError(f"session {session_id} is not open", "the open session", "open a session first")
        return course

    def _take_event(self, event: AnyEvent) -> None:
        if isinstance(event, SessionClosed):
            self._closed.set()
        if self._course is not None:
            self._journal.note_event(self._course.plan.id, event)

    def _station_died(self, words: str) -> None:
        self._closed.set()
        if self._course is not None:
            self._course.interrupted = True
            self._journal.note(self._course.plan.id, "interrupted", f"the station died: {words}")


def _wish_for(action: Action, who: str) -> Callable[[int], Wish]:
    reason = f"{who} pressed {action}"
    makers: dict[Action, Callable[[int], Wish]] = {
        "start": lambda number: Enable(number=number),
        "hold": lambda number: Hold(number=number, reason=reason),
        "resume": lambda number: Resume(number=number),
        "stop": lambda number: Stop(number=number, reason=reason),
        "reset": lambda number: Reset(number=number),
    }
    return makers[action]


def _check_game(name: str) -> None:
    if name not in GAMES:
        raise InputError(f"there is no game '{name}'", f"one of {', '.join(sorted(GAMES))}", "choose one of these")


def _check_side(form: SessionOpen, patient: Patient) -> None:
    affected = Side(patient.healthy_side).other
    if form.confirmed_affected_side != affected:
        raise RefusedError(
            f"{patient.name}'s affected side is the {affected}, not the {form.confirmed_affected_side}",
            "the side that the patient's page names",
            "look which arm is in the exoskeleton; correct the patient's healthy side if that is wrong",
        )
