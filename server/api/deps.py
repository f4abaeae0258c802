"""What routes may ask for, as named types.

What waits for nothing is asynchronous: the others each take a turn in a thread, and a stop would wait for all of them.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from fastapi import Depends, Header, Request
from fastapi.concurrency import run_in_threadpool
from fastapi.security import APIKeyCookie
from sqlmodel import Session

from db.account import Account
from db.patient import Patient
from db.queries import patients
from server.api.auth import COOKIE, Auth
from server.api.authority import PAGE_NAME, Client
from server.api.controls import Controls
from server.api.errors import ApiError, not_found
from server.api.figures import Figures
from server.api.forms import Number
from server.api.game_controls import GameControls
from server.api.service import Service
from server.api.therapy import Therapy

cookie_scheme = APIKeyCookie(name=COOKIE, auto_error=False, description="Set by logging in; HttpOnly.")


async def get_service(request: Request) -> Service:
    """Everything that runs behind this application."""
    service: Service = request.app.state.service
    return service


ServiceDep = Annotated[Service, Depends(get_service)]


def get_session(service: ServiceDep) -> Iterator[Session]:
    """A unit of work in the database, stored when the route is done and before the answer leaves."""
    with service.database.session() as session:
        yield session


async def get_auth(service: ServiceDep) -> Auth:
    """Who may do what."""
    return service.auth


async def get_therapy(service: ServiceDep) -> Therapy:
    """The session that is going on."""
    return service.therapy


async def get_figures(service: ServiceDep) -> Figures:
    """What recordings say."""
    return service.figures


async def get_controls(service: ServiceDep) -> Controls:
    """What people want of the arm."""
    return service.controls


async def get_game_controls(service: ServiceDep) -> GameControls:
    """What people want of the games."""
    return service.game_controls


SessionDep = Annotated[Session, Depends(get_session, scope="function")]
AuthDep = Annotated[Auth, Depends(get_auth)]
TherapyDep = Annotated[Therapy, Depends(get_therapy)]
FiguresDep = Annotated[Figures, Depends(get_figures)]
ControlsDep = Annotated[Controls, Depends(get_controls)]
GameControlsDep = Annotated[GameControls, Depends(get_game_controls)]
TokenDep = Annotated[str | None, Depends(cookie_scheme)]


async def get_account(auth: AuthDep, token: TokenDep) -> Account:
    """Who is logged in; 401 where nobody is. Of whoever was a moment ago, no database and no thread is waited for."""
    known = auth.recognised(token)
    return await run_in_threadpool(auth.account_of, token) if known is None else known


AccountDep = Annotated[Account, Depends(get_account)]


async def get_therapist(account: AccountDep) -> Account:
    """Who is logged in; 403 where that is the patient's screen."""
    if not account.role.may_treat:
        raise ApiError(403, f"{account.name} may not do this", "a therapist's account", "log in with one")
    return account


TherapistDep = Annotated[Account, Depends(get_therapist)]


def get_patient(patient_id: Number, _: TherapistDep, session: SessionDep) -> Patient:
    """The patient whom the address names, for those who treat; 404 where there is none."""
    patient = patients.find_patient(session, patient_id)
    if patient is None:
        raise not_found("patient", patient_id)
    return patient


PatientDep = Annotated[Patient, Depends(get_patient)]
PageName = Annotated[
    str,
    Header(
        alias="Mirrorlimb-Client",
        pattern=PAGE_NAME,
        description="What the page calls itself, the same as at its stream's opening.",
    ),
]


async def get_client(account: AccountDep, page: PageName = "") -> Client:
    """The page that asks."""
    return Client(account.id or 0, account.name, page)


ClientDep = Annotated[Client, Depends(get_client)]
