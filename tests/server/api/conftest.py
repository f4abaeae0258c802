"""The real application on a real port, with the real database; its station made of paper where a test bends it."""

import socket
import threading
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import httpx
import msgspec
import pytest
import uvicorn
import zstandard
from websockets.sync.client import connect

from fusion.skeleton import Side
from server.api.app import create_app
from server.api.auth import COOKIE, AuthSettings
from server.api.serve import settle_memory
from server.config import Config
from server.messages import DriveState

QUICK = AuthSettings(argon2_time_cost=1, argon2_memory_kib=64)
STAND_IN = (str(Path(__file__).with_name("stand_in_station.py")),)
NAME, PASSWORD = "Dr. Lin", "three quiet herons"


@dataclass
class Running:
    """A running service."""

    url: str
    app: object
    data: Path

    @property
    def service(self):
        return self.app.state.service

    @property
    def ws_url(self):
        return self.url.replace("http", "ws")

    def client(self, **more):
        return httpx.Client(base_url=self.url, timeout=20, trust_env=False, **more)


@contextmanager
def running(data, settings=QUICK, station=STAND_IN, config=None, built=Path("nowhere")):
    """Serve until the block ends; fails when the shutdown hangs."""
    app = create_app(config or Config(demo=True), data, settings, built, station)
    listener = socket.create_server(("127.0.0.1", 0))
    server = uvicorn.Server(
        uvicorn.Config(app, log_config=None, ws_per_message_deflate=False, timeout_graceful_shutdown=2)
    )
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]})
    thread.start()
    while not server.started and thread.is_alive():
        thread.join(0.01)
    try:
        if not server.started:
            raise app.state.failure
        settle_memory()
        yield Running(f"http://127.0.0.1:{listener.getsockname()[1]}", app, data)
    finally:
        server.should_exit = True
        thread.join(20)
        listener.close()
        assert not thread.is_alive()


@pytest.fixture(scope="session")
def paper_tick():
    """A tick of the stand-in station: nobody has begun, all is seen."""
    spec = spec_from_file_location("stand_in_station", Path(STAND_IN[0]))
    station = module_from_spec(spec)
    spec.loader.exec_module(station)
    return station.tick(0, 10.0, DriveState.READY, "1", Side.RIGHT)


@pytest.fixture(scope="session")
def shared(tmp_path_factory):
    """One service for all tests that leave no trace but rows."""
    with running(tmp_path_factory.mktemp("shared")) as service:
        with service.client() as client:
            client.post("/api/setup", json={"name": NAME, "password": PASSWORD}).raise_for_status()
        yield service


@pytest.fixture
def stranger(shared):
    """Somebody who is not logged in."""
    with shared.client() as client:
        yield client


@pytest.fixture
def therapist(shared):
    """Somebody who is."""
    with as_therapist(shared) as client:
        yield client


@contextmanager
def as_therapist(service):
    """A client of somebody who is logged in; makes the first account where there is none."""
    auth = service.service.auth
    account = (auth.set_up if auth.is_first_start() else auth.log_in)(NAME, PASSWORD, "test")[0]
    with service.client(headers={"Mirrorlimb-Client": "dashboard"}) as client:
        client.cookies.set(COOKIE, auth.open_login(account))
        yield client


@pytest.fixture
def serving():
    """`running`, for tests that start and end services of their own."""
    return running


@pytest.fixture
def logged_in():
    """`as_therapist`, likewise."""
    return as_therapist


@pytest.fixture
def alone(tmp_path):
    """A service that this test may break."""
    with running(tmp_path) as service:
        yield service


@pytest.fixture
def person(alone):
    """Somebody logged in to `alone`."""
    with as_therapist(alone) as client:
        yield client


@pytest.fixture
def enrol(sign):
    """Enrols a patient whose healthy side is the right one, and signs for the limits."""

    def enrolled(client, name="Wang", **more):
        form = {"name": name, "healthy_side": "right", **more}
        return sign(client, client.post("/api/patients", json=form).raise_for_status().json())

    return enrolled


@pytest.fixture
def new_patient(therapist, enrol):
    """Enrols a patient with the shared service."""
    return lambda name="Wang", **more: enrol(therapist, name, **more)


CAMERA = {
    "type": "ViewerCameraMessage",
    "wxyz": (1.0, 0.0, 0.0, 0.0),
    "position": (0.0, 0.0, 0.0),
    "fov": 1.0,
    "near": 0.1,
    "far": 10.0,
    "image_height": 480,
    "image_width": 640,
    "look_at": (0.0, 0.0, 1.0),
    "up_direction": (0.0, 1.0, 0.0),
}
"""viser counts a page as one of its own once it has said where it looks from."""


class VisersPage:
    """The socket of viser's page, through our door."""

    def __init__(self, socket):
        self.socket = socket

    def look(self):
        self.socket.send(msgspec.msgpack.encode(CAMERA))

    def wait_until_moved(self, names):
        """Until all of these things have been put somewhere else."""
        moved = set()
        while not names <= moved:
            updates = [m for m in _inside(self.socket.recv(timeout=20)) if "batched_positions" in m.get("updates", {})]
            moved |= {message["name"] for message in updates}


def _inside(window):
    """The messages in one of viser's windows: two lengths, then compressed msgpack, then plain arrays."""
    length = int.from_bytes(window[8:16], "little")
    return msgspec.msgpack.decode(zstandard.decompress(window[16 : 16 + length]))["messages"]


@pytest.fixture
def visers_page():
    """Opens viser's socket at a path, for somebody who is logged in."""

    @contextmanager
    def opened(service, client, path):
        with connect(
            f"{service.ws_url}{path}",
            additional_headers={"Cookie": f"{COOKIE}={client.cookies[COOKIE]}"},
            origin=service.url,
            subprotocols=["viser-v1.1.1"],
            max_size=None,
            compression=None,
        ) as socket:
            yield VisersPage(socket)

    return opened
