"""The real-time side, and the games that can be chosen."""

from __future__ import annotations

from fastapi import APIRouter

from games.catalogue import GAMES
from server.api.deps import AccountDep, ServiceDep
from server.api.errors import answers
from server.api.forms import GamePublic, Station
from server.api.service import describe_station

router = APIRouter(tags=["station"])


@router.get("/station", responses=answers(401, 503))
async def read_station(_: AccountDep, service: ServiceDep) -> Station:
    """Ports, drive, state and latencies of the real-time side."""
    return describe_station(service)


@router.get("/games", responses=answers(401, 503))
def list_games(_: AccountDep) -> list[GamePublic]:
    """The games that can be chosen."""
    return [GamePublic(name=name) for name in sorted(GAMES)]
