"""A past session, shown again in a 3-D view of its own."""

from __future__ import annotations

from fastapi import APIRouter

from server.api.deps import ServiceDep, TherapistDep
from server.api.errors import answers
from server.api.replay3d_forms import ReplayForm, ReplayPublic, Timeline

router = APIRouter(prefix="/replay", tags=["replay"])


@router.put("", responses=answers(401, 403, 404, 409, 422, 503))
async def play_again(form: ReplayForm, _: TherapistDep, service: ServiceDep) -> ReplayPublic:
    """Show a past session at `/replay3d/`, or change how it runs. There is one replay for everybody who looks, and none
    while a session is open: the machine is needed for the arm.
    """
    return await service.replay.play(form)


@router.get("", responses=answers(401, 403, 503))
async def read_replay(_: TherapistDep, service: ServiceDep) -> ReplayPublic | None:
    """How the replay stands, or null: none has been asked for, nobody has looked for a minute, or a session is open."""
    return service.replay.view()


@router.get("/timeline", responses=answers(401, 403, 503))
async def read_timeline(_: TherapistDep, service: ServiceDep) -> Timeline | None:
    """The states, hits, misses and calls of pain of the session that is shown, or null."""
    return service.replay.timeline()
