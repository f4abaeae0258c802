"""The real-time side, and the games that can be chosen."""

from __future__ import annotations

from fastapi import APIRouter

from games.catalogue import GAMES
from server.api.deps import AccountDep, ServiceDep
from server.api.errors import answers
from server.api.forms import GamePublic, Station, View3DColours, View3DLook, View3DShown
from server.api.service import describe_station
from server.api.view3d_scene import BOUND, EXO, FUSED, MIRRORED, SENSOR_COLOURS, Colour, Shown

router = APIRouter(tags=["station"])


def _written(colour: Colour) -> str:
    return "#{:02x}{:02x}{:02x}".format(*colour)


COLOURS = View3DColours(
    fused=_written(FUSED),
    mirrored=_written(MIRRORED),
    exoskeleton=_written(EXO),
    bounds=_written(BOUND),
    sensors=[_written(colour) for colour in SENSOR_COLOURS],
)


@router.get("/station", responses=answers(401, 503))
async def read_station(_: AccountDep, service: ServiceDep) -> Station:
    """Ports, drive, state and latencies of the real-time side."""
    return describe_station(service)


@router.get("/view3d", responses=answers(401, 503))
def read_view3d(_: AccountDep, service: ServiceDep) -> View3DLook:
    """What the 3-D view shows, and in which colours."""
    shown = service.view3d.shown
    return View3DLook(shown=View3DShown(sensors=shown.sensors, bounds=shown.bounds), colours=COLOURS)


@router.put("/view3d", responses=answers(401, 422, 503))
def show_in_view3d(form: View3DShown, _: AccountDep, service: ServiceDep) -> View3DShown:
    """Choose what the 3-D view shows, for everybody who looks."""
    service.view3d.shown = Shown(sensors=form.sensors, bounds=form.bounds)
    return form


@router.get("/games", responses=answers(401, 503))
def list_games(_: AccountDep) -> list[GamePublic]:
    """The games that can be chosen."""
    return [GamePublic(name=name) for name in sorted(GAMES)]
