"""The bus between processes is a CAN bus: every message reaches everybody else, once and whole."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from threading import Event, Thread

import can
import pytest

from server.emulated.cia402.bridge import LOOPBACK, SocketcandBus

MESSAGES = [
    can.Message(arbitration_id=0x80, is_extended_id=False, data=b""),
    can.Message(arbitration_id=0x201, is_extended_id=False, data=bytes(range(8))),
    can.Message(arbitration_id=0x1FFFFFFF, is_extended_id=True, data=b"\xff\x00"),
]


@contextmanager
def _bus(clients: int) -> Iterator[tuple[list[can.Message], list[can.BusABC], SocketcandBus]]:
    heard: list[can.Message] = []
    ended = Event()
    with SocketcandBus() as owner, ExitStack() as stack:

        def read() -> None:
            while not ended.is_set():
                message = owner.recv(0.01)
                if message is not None:
                    heard.append(message)

        thread = Thread(target=read)
        thread.start()
        stack.callback(thread.join)
        stack.callback(ended.set)
        opened = [
            stack.enter_context(can.Bus(interface="socketcand", channel="can0", host=LOOPBACK, port=owner.port))
            for _ in range(clients)
        ]
        yield heard, opened, owner


def _content(message: can.Message) -> tuple[int, bool, bytes]:
    return message.arbitration_id, message.is_extended_id, bytes(message.data)


def test_what_a_client_sends_reaches_the_owner_and_every_other_client_but_not_itself() -> None:
    with _bus(3) as (heard, (sender, one, other), _):
        for message in MESSAGES:
            sender.send(message)
        for client in (one, other):
            assert [_content(client.recv(2.0)) for _ in MESSAGES] == list(map(_content, MESSAGES))
        assert list(map(_content, heard)) == list(map(_content, MESSAGES))
        assert sender.recv(0.05) is None


def test_what_the_owner_sends_reaches_every_client() -> None:
    with _bus(2) as (_, clients, owner):
        owner.send(MESSAGES[1])
        assert [_content(client.recv(2.0)) for client in clients] == [_content(MESSAGES[1])] * 2


def test_a_client_that_goes_leaves_the_others_connected() -> None:
    with _bus(2) as (heard, (going, staying), owner):
        going.shutdown()
        owner.send(MESSAGES[1])
        assert _content(staying.recv(2.0)) == _content(MESSAGES[1])
        assert heard == []


def test_it_listens_on_loopback_only() -> None:
    with SocketcandBus() as bus:
        assert LOOPBACK in bus.channel_info
        with pytest.raises(OSError):  # noqa: PT011  # whatever the system calls a port that is taken
            SocketcandBus(bus.port)
