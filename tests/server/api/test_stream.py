"""A page gets the newest tick, and only after it has drawn the one before."""

import json
import time

import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from server.api.auth import COOKIE


@pytest.fixture
def open_stream(shared, therapist):
    sockets = []

    def opened():
        headers = {"Cookie": f"{COOKIE}={therapist.cookies[COOKIE]}"}
        socket = connect(f"{shared.ws_url}/api/stream", additional_headers=headers, origin=shared.url)
        sockets.append(socket)
        return socket

    yield opened
    for socket in sockets:
        socket.close()


def read(socket):
    return json.loads(socket.recv(timeout=10))


def read_on(socket):
    while True:
        socket.recv(timeout=10)


def draw(socket, message):
    socket.send(json.dumps({"ack": message["tick"]["index"], "drawn_on": "patient"}))


def test_ticks_come_in_order_while_they_are_drawn(open_stream):
    socket, indices = open_stream(), []
    for _ in range(10):
        message = read(socket)
        indices.append(message["tick"]["index"])
        draw(socket, message)
    assert indices == sorted(set(indices))
    assert set(message) == {"tick", "game", "session"}


def test_a_page_that_draws_nothing_gets_nothing_more(open_stream):
    socket = open_stream()
    read(socket)
    with pytest.raises(TimeoutError):
        socket.recv(timeout=0.3)


def test_after_a_pause_the_newest_tick_comes_and_not_the_next(open_stream):
    slow, quick = open_stream(), open_stream()
    first = read(slow)
    for _ in range(20):
        newest = read(quick)
        draw(quick, newest)
    draw(slow, first)
    assert read(slow)["tick"]["index"] >= newest["tick"]["index"]


def test_a_page_that_draws_nothing_slows_no_other(open_stream):
    asleep, awake = open_stream(), open_stream()
    read(asleep)
    for _ in range(20):
        draw(awake, read(awake))


def test_an_acknowledgement_of_something_else_brings_nothing(open_stream):
    socket = open_stream()
    message = read(socket)
    socket.send(json.dumps({"ack": message["tick"]["index"] + 1000}))
    with pytest.raises(TimeoutError):
        socket.recv(timeout=0.2)
    draw(socket, message)
    assert read(socket)["tick"]["index"] > message["tick"]["index"]


@pytest.mark.parametrize("nonsense", ["", "{}", "[]", '{"ack": "x"}', "\x00", '{"ack": 1e400}'])
def test_nonsense_closes_the_socket_with_a_reason(open_stream, nonsense):
    socket = open_stream()
    socket.send(nonsense)
    with pytest.raises(ConnectionClosed) as closed:
        read_on(socket)
    assert closed.value.rcvd.code == 1003
    assert "ack" in closed.value.rcvd.reason


def test_the_time_to_the_picture_is_what_the_page_took(shared, therapist, open_stream):
    socket = open_stream()
    for _ in range(5):
        message = read(socket)
        time.sleep(0.05)
        draw(socket, message)
    read(socket)
    latency = therapist.get("/api/station").json()["latency"]
    assert latency["datagram_to_picture"]["samples"] >= 5
    assert latency["datagram_to_picture"]["p99_s"] >= 0.05
    assert latency["datagram_to_command"]["p50_s"] == pytest.approx(0.006)


def test_a_hidden_window_measures_nothing(shared, therapist, open_stream):
    before = therapist.get("/api/station").json()["latency"]
    socket = open_stream()
    for _ in range(3):
        socket.send(json.dumps({"ack": read(socket)["tick"]["index"]}))
    after = therapist.get("/api/station").json()["latency"]
    for screen in ("datagram_to_picture", "datagram_to_dashboard"):
        assert after[screen]["samples"] == before[screen]["samples"]


def test_a_page_that_leaves_is_forgotten(shared, open_stream):
    before = shared.service.relay.pages.readers
    socket = open_stream()
    read(socket)
    assert shared.service.relay.pages.readers == before + 1
    socket.close()
    for _ in range(100):
        if shared.service.relay.pages.readers == before:
            return
        time.sleep(0.05)
    pytest.fail("the page is still served")
