"""Logging in and out, the first account, the demonstration."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response

from db.account import Account, AccountPublic
from db.patient import PatientPublic
from server import __version__
from server.api.auth import clear_cookie, client_of, set_cookie
from server.api.deps import AccountDep, AuthDep, ServiceDep, TokenDep
from server.api.errors import answers
from server.api.forms import Credentials, DemoWelcome, NewCredentials, Status

router = APIRouter(tags=["accounts"])


@router.get("/status", responses=answers(503))
def status(request: Request, service: ServiceDep, token: TokenDep) -> Status:
    """What a page needs to know before anybody has logged in. Needs no log-in."""
    account = service.auth.account_or_none(token)
    return Status(
        version=__version__,
        first_start=service.auth.is_first_start(),
        demo=service.demo.is_open_to(client_of(request)),
        account=None if account is None else _public(account),
    )


@router.post("/setup", status_code=201, responses=answers(409, 422, 429, 503))
def setup(form: NewCredentials, request: Request, response: Response, auth: AuthDep) -> AccountPublic:
    """Make the first account and log in to it; refused once there is one. Needs no log-in."""
    account, token = auth.set_up(form.name, form.password, client_of(request))
    set_cookie(response, token, request)
    return _public(account)


@router.post("/login", responses=answers(401, 422, 429, 503))
def login(form: Credentials, request: Request, response: Response, auth: AuthDep, token: TokenDep) -> AccountPublic:
    """Log in. Needs no log-in."""
    account, new_token = auth.log_in(form.name, form.password, client_of(request), replaced=token)
    set_cookie(response, new_token, request)
    return _public(account)


@router.post("/logout", status_code=204, responses=answers(401, 503))
def logout(_: AccountDep, response: Response, auth: AuthDep, token: TokenDep) -> None:
    """Log out; the token is worthless from now on."""
    auth.log_out(token)
    clear_cookie(response)


@router.get("/me", responses=answers(401, 503))
def me(account: AccountDep) -> AccountPublic:
    """Who is logged in."""
    return _public(account)


@router.post("/demo", responses=answers(403, 503))
def demo(request: Request, response: Response, service: ServiceDep) -> DemoWelcome:
    """Enter the demonstration; only with `--demo`, from this machine, with a simulated drive. Needs no log-in."""
    account, patient, token = service.demo.enter(client_of(request))
    set_cookie(response, token, request)
    return DemoWelcome(account=_public(account), patient=PatientPublic.model_validate(patient))


def _public(account: Account) -> AccountPublic:
    return AccountPublic.model_validate(account)
