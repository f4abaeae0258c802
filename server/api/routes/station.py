"""The real-time side."""

from __future__ import annotations

from fastapi import APIRouter

from server.api.deps import AccountDep, ServiceDep
from server.api.errors import answers
from server.api.forms import Station

router = APIRouter(tags=["station"])


@router.get("/station", responses=answers(401, 503))
async def read_station(_: AccountDep, service: ServiceDep) -> Station:
    """Ports, drive, state and latencies of the real-time side."""
    return service.describe_station()
