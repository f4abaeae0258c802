"""Everything that runs behind the application: opened in order, closed in reverse."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import AsyncExitStack, asynccontextmanager
from dataclasses import dataclass
from pathlib import Path

from fastapi.concurrency import run_in_threadpool

from db.database import Database, open_database
from server.api.auth import Auth, AuthSettings
from server.api.authority import Authority, Presence
from server.api.controls import Controls
from server.api.course import warm_up
from server.api.data_folder import DATABASE, until_station_is_gone
from server.api.demo import Demo
from server.api.figures import Figures
from server.api.forms import Station
from server.api.game_controls import GameControls
from server.api.game_room import GameRoom
from server.api.journal import Journal
from server.api.latency import LatencyMeter
from server.api.limits import snapshots
from server.api.recover import close_left_open, measure_all
from server.api.relay import Relay
from server.api.replay3d import Replay
from server.api.station_link import StationLink
from server.api.therapy import Therapy
from server.api.view3d import View3D
from server.config import Config
from server.messages import DriveState

SIMULATED = "simulated"
"""Name of the drive that moves nobody."""


@dataclass(frozen=True, slots=True)
class Service:
    """The parts of a running service."""

    config: Config
    database: Database
    auth: Auth
    demo: Demo
    link: StationLink
    presence: Presence
    therapy: Therapy
    controls: Controls
    game_controls: GameControls
    figures: Figures
    latency: LatencyMeter
    relay: Relay
    view3d: View3D
    replay: Replay


@asynccontextmanager
async def running_service(
    config: Config, data: Path, auth_settings: AuthSettings, station: tuple[str, ...]
) -> AsyncIterator[Service]:
    """The service, while the block lasts.

    Raises:
        DatabaseError: the database cannot be opened.
        MachineError: the station does not come up.
    """
    async with AsyncExitStack() as stack:
        database = open_database(data / DATABASE)
        stack.callback(database.close)
        auth = Auth(database, auth_settings)
        link = StationLink(config, data, station)
        journal = Journal(database)
        presence = Presence(link.beat)
        authority = Authority(presence)
        figures = Figures(data, database, journal)
        therapy = Therapy(config, data, database, link, journal, figures, authority, GameRoom(journal, presence))
        link.in_charge = therapy.in_charge
        controls = Controls(therapy.opened, link, journal, authority)
        game_controls = GameControls(therapy.opened, database, journal, authority, presence)
        latency = LatencyMeter()
        relay = Relay(therapy, latency)
        view3d = View3D(relay.viewers)
        journal.start()
        stack.push_async_callback(journal.close)
        stack.push_async_callback(therapy.close)
        view3d.start()
        stack.push_async_callback(view3d.close)
        replay = Replay(data, database, lambda: therapy.is_open)
        stack.push_async_callback(replay.close)
        link.on_tick.append(relay.take)
        stack.push_async_callback(link.close)
        await until_station_is_gone(data)
        await run_in_threadpool(warm_up)
        left = await close_left_open(database, data)
        await link.open()
        recovery = asyncio.create_task(measure_all(figures, left), name="recovery")
        stack.callback(recovery.cancel)
        demo = Demo(database, auth, config.demo and config.station.exoskeleton.drive == SIMULATED)
        yield Service(
            config=config,
            database=database,
            auth=auth,
            demo=demo,
            link=link,
            presence=presence,
            therapy=therapy,
            controls=controls,
            game_controls=game_controls,
            figures=figures,
            latency=latency,
            relay=relay,
            view3d=view3d,
            replay=replay,
        )


def describe_station(service: Service) -> Station:
    """The real-time side as it stands."""
    link = service.link
    tick = link.latest
    return Station(
        up=link.up is not None,
        ports={} if link.up is None else link.up.ports,
        drive=service.config.station.exoskeleton.drive,
        simulated=service.config.station.exoskeleton.drive == SIMULATED,
        state=DriveState.OFF if tick is None else tick.state,
        reason=link.trouble if tick is None else tick.reason,
        restarts=link.restarts,
        latency=service.latency.read(),
        device=list(snapshots(service.config.station.device)),
        soft_margin_rad=service.config.station.gate.soft_margin_rad,
    )
