"""Who is at the other end: passwords, log-ins and the cookie that carries them."""

from __future__ import annotations

import hashlib
import secrets
import threading
import time
from dataclasses import dataclass
from datetime import timedelta
from math import ceil

from argon2 import PasswordHasher
from argon2.exceptions import InvalidHashError, VerifyMismatchError
from fastapi import Request, Response

from db.account import Account, LoginSession, Role
from db.columns import now_utc
from db.database import Database
from db.errors import DatabaseError
from db.queries import accounts
from fusion.errors import RefusedError
from server.api.errors import ApiError
from server.api.recognised import Recognised
from server.api.throttle import Throttle

COOKIE = "mirrorlimb_login"


@dataclass(frozen=True, slots=True)
class AuthSettings:
    """How long a log-in lasts and how much work a password costs."""

    idle_s: float = 30 * 60.0
    absolute_s: float = 12 * 3600.0
    argon2_time_cost: int = 3
    argon2_memory_kib: int = 64 * 1024
    argon2_parallelism: int = 1
    """One lane: a log-in must not take both cores of a small station."""
    touch_every_s: float = 30.0
    """A use is noted at most this often, to spare the disk."""


class Auth:
    """Accounts and their log-ins. Safe to use from several threads."""

    def __init__(self, database: Database, settings: AuthSettings) -> None:
        self._database, self._settings = database, settings
        self._hasher = PasswordHasher(
            settings.argon2_time_cost, settings.argon2_memory_kib, settings.argon2_parallelism
        )
        # Somebody who guesses names must not be told by the clock that one does not exist.
        self._nobodys_hash = self._hasher.hash(secrets.token_urlsafe())
        self._per_name, self._per_client = Throttle(free=5), Throttle(free=30)
        self._lock = threading.Lock()
        self._recognised = Recognised()

    def is_first_start(self) -> bool:
        """There is no account yet."""
        with self._database.session() as session:
            return accounts.count_accounts(session) == 0

    def set_up(self, name: str, password: str, client: str) -> tuple[Account, str]:
        """Make the first account and log in to it.

        Raises:
            RefusedError: there is an account already.
        """
        self._attempt(name, client)
        with self._lock, self._database.session() as session:
            if accounts.count_accounts(session) > 0:
                raise RefusedError("the first account exists already", "a log-in", "log in with that account")
            account = accounts.add_account(session, name, self._hasher.hash(password), Role.ADMIN)
        self._forgive(name, client)
        return account, self.open_login(account)

    def log_in(self, name: str, password: str, client: str, replaced: str | None = None) -> tuple[Account, str]:
        """The account and a new token; a token that was in use before is worthless afterwards.

        Raises:
            ApiError: 401 for a wrong name or password, 429 when there were too many.
        """
        self._attempt(name, client)
        with self._database.session() as session:
            account = accounts.find_account(session, name)
        if not self._matches(account, password) or account is None:
            raise ApiError(401, "name or password is wrong", "an account's name and its password", "type them again")
        self._forgive(name, client)
        self.log_out(replaced)
        return account, self.open_login(account)

    def open_login(self, account: Account) -> str:
        """A new token for that account; only its hash is kept."""
        token, now = secrets.token_urlsafe(32), now_utc()
        ends = now + timedelta(seconds=self._settings.absolute_s)
        with self._database.session() as session:
            accounts.remove_old_logins(session, now - timedelta(seconds=self._settings.idle_s), now)
            login = LoginSession(token_hash=_hash_of(token), account_id=account.id or 0, expires_at=ends)
            accounts.add_login(session, login)
        return token

    def log_out(self, token: str | None) -> None:
        """Make the token worthless."""
        if token:
            self._recognised.note(_hash_of(token), None)
            with self._database.session() as session:
                accounts.remove_login(session, _hash_of(token))

    def account_or_none(self, token: str | None, is_use: bool = True) -> Account | None:
        """Whose token this is, while its log-in lasts. `is_use` false only looks, and does not prolong it.

        While the database does not answer, its last answer holds.

        Raises:
            DatabaseError: it does not answer, and has never said whose this is.
        """
        if not token:
            return None
        token_hash = _hash_of(token)
        try:
            account = self._looked_up(token_hash, is_use)
        except DatabaseError:
            account = self._recognised.ever(token_hash)
            if account is None:
                raise
        self._recognised.note(token_hash, account)
        return account

    def recognised(self, token: str | None) -> Account | None:
        """Whose token this was a moment ago; asks no database and never waits."""
        return self._recognised.lately(_hash_of(token)) if token else None

    def _looked_up(self, token_hash: str, is_use: bool) -> Account | None:
        now, settings = now_utc(), self._settings
        with self._database.session() as session:
            found = accounts.find_login(session, token_hash)
            if found is None:
                return None
            login, account = found
            unused_s = (now - login.last_used_at).total_seconds()
            if unused_s > settings.idle_s or now > login.expires_at:
                return None
            if is_use and unused_s > settings.touch_every_s:
                login.last_used_at = now
            return account

    def account_of(self, token: str | None) -> Account:
        """Whose token this is.

        Raises:
            ApiError: 401 where it is nobody's.
        """
        account = self.account_or_none(token)
        if account is None:
            raise ApiError(401, "nobody is logged in", "a log-in that has not run out", "log in")
        return account

    def _matches(self, account: Account | None, password: str) -> bool:
        wanted = account.password_hash if account is not None else None
        try:
            return self._hasher.verify(wanted or self._nobodys_hash, password) and wanted is not None
        except (VerifyMismatchError, InvalidHashError):
            return False

    def _attempt(self, name: str, client: str) -> None:
        """Count an attempt as failed before it is tried, so that many at once gain nothing."""
        now_s = time.monotonic()
        with self._lock:
            wait_s = max(self._per_name.wait_s(_key(name, client), now_s), self._per_client.wait_s(client, now_s))
            if wait_s > 0:
                raise ApiError(429, "too many wrong passwords", "a pause", f"wait {ceil(wait_s)} seconds")
            self._per_name.failed(_key(name, client), now_s)
            self._per_client.failed(client, now_s)

    def _forgive(self, name: str, client: str) -> None:
        with self._lock:
            self._per_name.succeeded(_key(name, client))
            self._per_client.succeeded(client)


def _key(name: str, client: str) -> str:
    return f"{client} {name}"


def _hash_of(token: str) -> str:
    # A token has 256 random bits, so a plain hash cannot be searched; argon2 is for what people make up.
    return hashlib.sha256(token.encode()).hexdigest()


def client_of(request: Request) -> str:
    """Address of whoever asks."""
    return "" if request.client is None else request.client.host


def set_cookie(response: Response, token: str, request: Request) -> None:
    """Hand the token to the browser, out of reach of scripts and of other sites."""
    response.set_cookie(COOKIE, token, httponly=True, samesite="strict", secure=request.url.scheme == "https", path="/")


def clear_cookie(response: Response) -> None:
    """Take the token back."""
    response.delete_cookie(COOKIE, httponly=True, samesite="strict", path="/")
