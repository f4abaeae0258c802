"""A therapy session from patient to saved metrics."""

from __future__ import annotations

from db.account import Account
from db.therapy_session import SessionDetail, SessionPublic
from server.api.forms import Action, Answer, Curves, Follow, SessionOpen


class Therapy:
    """The session that is going on."""

    async def open(self, form: SessionOpen, account: Account) -> SessionPublic:
        """Open."""
        raise NotImplementedError

    async def current(self) -> SessionPublic | None:
        """The open one."""
        raise NotImplementedError

    async def control(self, session_id: int, action: Action, account: Account) -> Answer:
        """Control."""
        raise NotImplementedError

    async def follow(self, session_id: int, form: Follow, account: Account) -> Answer:
        """Follow."""
        raise NotImplementedError

    async def end(self, session_id: int, pain_after: int | None, account: Account) -> SessionDetail:
        """End."""
        raise NotImplementedError

    async def curves(self, session_id: int) -> Curves:
        """Curves."""
        raise NotImplementedError
