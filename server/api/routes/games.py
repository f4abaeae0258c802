"""The games of the open session: what people wish of them, and where they place what they ask for."""

from __future__ import annotations

from fastapi import APIRouter

from server.api.deps import AccountDep, ClientDep, GameControlsDep, TherapistDep
from server.api.errors import answers
from server.api.forms import Number
from server.api.game_forms import GameAnswer, GameWish, SessionWorkspacePublic

router = APIRouter(prefix="/sessions/{session_id}", tags=["games"])


@router.post("/game", responses=answers(401, 409, 422, 503))
async def wish_of_game(
    session_id: Number, form: GameWish, account: AccountDep, client: ClientDep, controls: GameControlsDep
) -> GameAnswer:
    """Start, pause, go on, rest, go to the next exercise, quit, pin the difficulty or let it adapt. Pausing is for
    everybody who is logged in, going on for the patient's screen too, the rest for the page in charge.
    """
    return controls.wish(session_id, form, client, account)


@router.get("/workspace", responses=answers(401, 403, 409, 422, 503))
async def read_workspace(session_id: Number, _: TherapistDep, controls: GameControlsDep) -> SessionWorkspacePublic:
    """How far the healthy arm has shown, since the session was opened, that the games may ask the other to go."""
    return controls.workspace(session_id)


@router.post("/workspace", responses=answers(401, 403, 409, 422, 503))
async def take_workspace(
    session_id: Number, _: TherapistDep, client: ClientDep, controls: GameControlsDep
) -> SessionWorkspacePublic:
    """Let the games go by what has been shown; only for the page in charge, and only before the first game."""
    return await controls.take_workspace(session_id, client)
