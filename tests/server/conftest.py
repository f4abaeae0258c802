"""A page without a browser: what the tests of the service in a thread and in a process of its own share."""

import json
import threading

import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from server.api.auth import COOKIE


class Page:
    """A page of whoever `client` is logged in as: it looks, and answers every message as a browser's does."""

    def __init__(self, client, name, screen):
        self.client, self.headers = client, {"Mirrorlimb-Client": name}
        self.messages = []
        self.closed_with = None
        self._answers = True
        url = str(client.base_url).rstrip("/")
        self._socket = connect(
            f"{url.replace('http', 'ws')}/api/stream?client={name}",
            additional_headers={"Cookie": f"{COOKIE}={client.cookies[COOKIE]}"},
            origin=url,
        )
        self._reader = threading.Thread(target=self._read, args=(screen,))
        self._reader.start()

    def _read(self, screen):
        try:
            for text in self._socket:
                message = json.loads(text)
                self.messages.append(without_skeletons(message))
                if self._answers:
                    self._socket.send(json.dumps({"ack": message["tick"]["index"], "drawn_on": screen}))
        except ConnectionClosed as closed:
            self.closed_with = closed.rcvd and closed.rcvd.code

    def post(self, path, **form):
        """Ask for something, as this page."""
        return self.client.post(path, json=form, headers=self.headers)

    def pull(self):
        """The cable is pulled: nothing more is heard of the page, and nobody is told."""
        self._answers = False

    def close(self):
        """The page is left."""
        self._socket.close()
        self._reader.join(10)


def without_skeletons(message):
    """Thousands of kept points would make the garbage collector stop the service, which runs in the same process."""
    message["tick"]["body"] = None
    for sensor in message["tick"]["sensors"]:
        sensor["joints_in_room"] = []
    return message


@pytest.fixture
def look():
    """Opens pages, and closes them afterwards."""
    pages = []

    def opened(client, name="dashboard", screen="dashboard"):
        pages.append(Page(client, name, screen))
        return pages[-1]

    yield opened
    for page in pages:
        page.close()


@pytest.fixture
def sign():
    """Confirms a patient's limits as they are."""

    def signed(client, patient):
        seen = {key: patient[key] for key in ("passive_range", "force_limits", "assist_level_most")}
        return client.post(f"/api/patients/{patient['id']}/confirm-limits", json=seen).raise_for_status().json()

    return signed
