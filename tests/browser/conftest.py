"""A real Chromium for the browser tests."""

from __future__ import annotations

import functools
import http.server
import socket
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path
from threading import Event, Thread

import numpy as np
import pytest
from playwright.sync_api import Browser, Page, sync_playwright

from fusion.formats.registry import dialect_named
from fusion.skeleton import Side
from fusion.virtual_patient.anatomy import ArmPose
from fusion.virtual_patient.bystander import Bystander, Visit
from fusion.virtual_patient.patient import PoseGoal, VirtualPatient
from fusion.virtual_patient.trial import sensors_for
from server.cli.browser import find_browser

# Root in a container needs no-sandbox; the rest keeps Chromium from calling home.
ARGUMENTS = [
    "--no-sandbox",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
]
SHOTS = Path(__file__).parents[2] / "test-results"
STATIC = Path(__file__).parents[2] / "server" / "api" / "static"
STEP_S = 1 / 60
ADDRESSES = ("127.0.0.41", "127.0.0.42")
PATIENT, VISITOR = "72057594037930000", "72057594037939999"
"""As long as a Kinect's own numbers."""
POSES = tuple(
    PoseGoal(ArmPose(*np.radians(angles_deg).tolist()))
    for angles_deg in ((10, 60, -20, 30), (80, 80, 10, 10), (60, 30, 20, 100), (40, 90, -10, 60))
)
"""Plane, elevation, rotation and elbow of an arm that shows how far it goes."""
POSE_S = 1.5
ASK = """async ([method, path, body]) => {
  const answer = await fetch(path, {
    method,
    headers: {
      "content-type": "application/json",
      "mirrorlimb-client": sessionStorage.getItem("mirrorlimb.client.dashboard") ?? "",
    },
    body: body === null ? undefined : JSON.stringify(body),
  });
  if (!answer.ok) throw new Error(`${method} ${path}: ${answer.status} ${await answer.text()}`);
  return answer.json();
}"""
Ask = Callable[..., dict]


# By module: Playwright's event loop must have ended before other tests ask for one of their own.
@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """Chromium, headless; fails where there is none (`make test` sees to it before)."""
    path = find_browser()
    if path is None:
        pytest.fail("No Chromium found. `make browser` installs it or says what to type.")
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=path, args=ARGUMENTS)
        yield chromium
        chromium.close()


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    """A page at 1280×720 in a context of its own; the test fails where it threw an error."""
    context = browser.new_context(viewport={"width": 1280, "height": 720}, locale="en-GB")
    errors: list[str] = []
    context.on("weberror", lambda error: errors.append(str(error.error)))
    opened = context.new_page()
    yield opened
    context.close()
    assert not errors, errors


@pytest.fixture
def shots() -> Path:
    """Folder for screenshots, kept out of the repository."""
    SHOTS.mkdir(exist_ok=True)
    return SHOTS


def asked(page: Page, method: str, path: str, body: object = None) -> dict:
    """What the service answers a dashboard's page; an error where it refuses."""
    return page.evaluate(ASK, [method, path, body])


@pytest.fixture(scope="session")
def ask() -> Ask:
    """`asked`, for tests."""
    return asked


class Crowd:
    """Two virtual sensors that send real OSC of a patient and, once they have come, of somebody who stands beside."""

    def __init__(self) -> None:
        self._ended, self._visited, self._shows = Event(), Event(), Event()

    def visitor_comes(self) -> None:
        """Somebody steps into view."""
        self._visited.set()

    def show_range(self, shows: bool) -> None:
        """The patient moves the healthy arm to and fro, or rests again."""
        if shows:
            self._shows.set()
        else:
            self._shows.clear()

    def send(self, sockets: list[socket.socket]) -> None:
        """Send until the end, in real time."""
        dialect = dialect_named("kinectv2-osc")
        patient, visitor = VirtualPatient(Side.RIGHT, 3), Bystander(Visit.STANDS, 4)
        shown = [(PATIENT, sensors_for(Side.RIGHT, 3)), (VISITOR, sensors_for(Side.RIGHT, 30))]
        while not self._ended.wait(STEP_S):
            bodies = patient.step(STEP_S, self._goal(patient.t_s)), visitor.step(STEP_S)
            in_view = list(zip(shown, bodies, strict=True))
            for (number, sensors), positions in in_view if self._visited.is_set() else in_view[:1]:
                for opened, sensor in zip(sockets, sensors, strict=True):
                    sample = sensor.see(positions, patient.t_s)
                    for datagram in dialect.encode(replace(sample, body=number), 0) if sample else ():
                        opened.send(datagram)

    def _goal(self, t_s: float) -> PoseGoal | None:
        return POSES[int(t_s / POSE_S) % len(POSES)] if self._shows.is_set() else None

    def end(self) -> None:
        """Nothing is sent any more."""
        self._ended.set()


@pytest.fixture
def crowd() -> Callable[[int], AbstractContextManager[Crowd]]:
    """Sends to a port for as long as its `with` block lasts."""

    @contextmanager
    def before_the_sensors(port: int) -> Iterator[Crowd]:
        with ExitStack() as stack:
            sockets = [stack.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM)) for _ in ADDRESSES]
            for opened, address in zip(sockets, ADDRESSES, strict=True):
                opened.bind((address, 0))
                opened.connect(("127.0.0.1", port))
            people = Crowd()
            sending = Thread(target=people.send, args=(sockets,))
            sending.start()
            try:
                yield people
            finally:
                people.end()
                sending.join()

    return before_the_sensors


@contextmanager
def built_pages() -> Iterator[str]:
    """The address of the built pages, without a service behind them."""
    quiet = type("Quiet", (http.server.SimpleHTTPRequestHandler,), {"log_message": lambda *_: None})
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(quiet, directory=STATIC))
    Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}"
    server.shutdown()
    server.server_close()


@pytest.fixture
def pages() -> Iterator[str]:
    """Where the built pages are, for a test that says itself what the stream says."""
    with built_pages() as address:
        yield address
