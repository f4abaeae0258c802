"""Accounts and their log-ins."""

from __future__ import annotations

from datetime import datetime

from sqlalchemy import delete
from sqlmodel import Session, col, func, select

from db.account import Account, LoginSession, Role


def count_accounts(session: Session) -> int:
    """How many people may log in."""
    return session.exec(select(func.count()).select_from(Account)).one()


def find_account(session: Session, name: str) -> Account | None:
    """The account of that name."""
    return session.exec(select(Account).where(Account.name == name)).first()


def add_account(session: Session, name: str, password_hash: str | None, role: Role = Role.THERAPIST) -> Account:
    """A new account; without a hash nobody can log in to it with a password."""
    account = Account(name=name, password_hash=password_hash, role=role)
    session.add(account)
    session.flush()
    return account


def add_login(session: Session, login: LoginSession) -> None:
    """Remember a log-in."""
    session.add(login)
    session.flush()


def find_login(session: Session, token_hash: str) -> tuple[LoginSession, Account] | None:
    """The log-in with that token, and whose it is."""
    rows = select(LoginSession, Account).where(
        LoginSession.token_hash == token_hash, LoginSession.account_id == Account.id
    )
    return session.exec(rows).first()


def remove_login(session: Session, token_hash: str) -> None:
    """Forget a log-in."""
    session.execute(delete(LoginSession).where(col(LoginSession.token_hash) == token_hash))


def remove_old_logins(session: Session, unused_since: datetime, now: datetime) -> None:
    """Forget log-ins that ran out."""
    too_old = (col(LoginSession.last_used_at) < unused_since) | (col(LoginSession.expires_at) < now)
    session.execute(delete(LoginSession).where(too_old))
