"""The real-time side, and the games that can be chosen."""

from __future__ import annotations

from fastapi import APIRouter

from games.catalogue import GAMES
from server.api.deps import AccountDep, ServiceDep
from server.api.errors import answers
from server.api.forms import GamePublic, Station, View3DShown
from server.api.service import describe_station
from server.api.view3d_scene import Shown

router = APIRouter(tags=["station"])


@router.get("/station", responses=answers(401, 503))
async def read_station(_: AccountDep, service: ServiceDep) -> Station:
    """Ports, drive, state and latencies of the real-time side."""
    return describe_station(service)


@router.put("/view3d", responses=answers(401, 422, 503))
def show_in_view3d(form: View3DShown, _: AccountDep, service: ServiceDep) -> View3DShown:
    """Choose what the 3-D view shows, for everybody who looks."""
    service.view3d.shown = Shown(sensors=form.sensors, bounds=form.bounds)
    return form


@router.get("/games", responses=answers(401, 503))
def list_games(_: AccountDep) -> list[GamePublic]:
    """The games that can be chosen."""
    return [GamePublic(name=name) for name in sorted(GAMES)]
