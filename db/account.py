"""A person's account and the log-ins that are open on it."""

from __future__ import annotations

from datetime import datetime
from enum import StrEnum

from sqlmodel import Field, SQLModel

from db.columns import UtcDateTime, now_utc, word_of


class Role(StrEnum):
    """What an account is for."""

    ADMIN = "admin"
    THERAPIST = "therapist"
    SCREEN = "screen"
    """The patient's screen: it looks, and may hold, stop and call pain."""

    @property
    def may_treat(self) -> bool:
        """Whether such an account may enrol, sign for limits and be in charge of the arm."""
        return self is not Role.SCREEN


class AccountBase(SQLModel):
    """What every form of an account says."""

    name: str = Field(min_length=1, max_length=80, unique=True, index=True)
    role: Role = Field(default=Role.THERAPIST, sa_type=word_of(Role))


class Account(AccountBase, table=True):
    """Somebody who may log in. `password_hash` is null where no password can ever match (the demonstration)."""

    __tablename__ = "account"

    id: int | None = Field(default=None, primary_key=True)
    password_hash: str | None = Field(default=None, max_length=200)
    created_at: datetime = Field(default_factory=now_utc, sa_type=UtcDateTime)


class AccountPublic(AccountBase):
    """An account as the browser sees it."""

    id: int


class LoginSession(SQLModel, table=True):
    """One log-in. Only the token's hash is kept, so a stolen database opens no door."""

    __tablename__ = "login_session"

    token_hash: str = Field(primary_key=True, max_length=64)
    account_id: int = Field(foreign_key="account.id", index=True, ondelete="CASCADE")
    created_at: datetime = Field(default_factory=now_utc, sa_type=UtcDateTime)
    last_used_at: datetime = Field(default_factory=now_utc, sa_type=UtcDateTime)
    expires_at: datetime = Field(sa_type=UtcDateTime)
