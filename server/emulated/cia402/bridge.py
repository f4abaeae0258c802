"""A CAN bus between processes of this machine: the server's side of socketcand's protocol, on loopback.

Every process that opens python-can's interface "socketcand" at its port is on the bus, and hears all others. No kernel
module is needed, and no package beyond python-can.
"""

from __future__ import annotations

import select
import socket
import time
from collections import deque
from typing import Any

import can

LOOPBACK = "127.0.0.1"
_ANSWERS = {b"open": b"< ok >", b"rawmode": b"< ok >", b"echo": b"< echo >"}


class SocketcandBus(can.BusABC):
    """The bus as its owner sees it; clients come and go.

    Args:
        port: to listen on; 0 = any, see `port`.

    Raises:
        OSError: the port is taken.
    """

    def __init__(self, port: int = 0, **_: Any) -> None:
        self._listener = socket.create_server((LOOPBACK, port))
        self.port: int = self._listener.getsockname()[1]
        self.channel_info = f"socketcand on {LOOPBACK}:{self.port}"
        self._clients: dict[socket.socket, bytes] = {}
        self._heard: deque[can.Message] = deque()
        super().__init__(channel=self.port)

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        """Give a message to every client."""
        self._give(msg, None)

    def shutdown(self) -> None:
        """Close the port and every connection."""
        super().shutdown()
        for each in (self._listener, *self._clients):
            each.close()
        self._clients.clear()

    def _recv_internal(self, timeout: float | None) -> tuple[can.Message | None, bool]:
        if not self._heard:
            ready = select.select([self._listener, *self._clients], [], [], timeout)[0]
            for each in ready:
                self._welcome() if each is self._listener else self._hear(each)
        return (self._heard.popleft() if self._heard else None), False

    def _welcome(self) -> None:
        client = self._listener.accept()[0]
        client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._clients[client] = b""
        self._write(client, b"< hi >")

    def _hear(self, client: socket.socket) -> None:
        try:
            received = client.recv(65536)
        except OSError:
            received = b""
        if not received:
            self._lose(client)
            return
        *whole, self._clients[client] = (self._clients[client] + received).split(b">")
        for text in whole:
            self._understand(client, text.strip(b"< ").split())

    def _understand(self, client: socket.socket, words: list[bytes]) -> None:
        if not words:
            return
        if words[0] == b"send" and len(words) >= 3:
            message = can.Message(
                timestamp=time.time(),
                arbitration_id=int(words[1], 16),
                is_extended_id=len(words[1]) > 3,
                data=bytes(int(byte, 16) for byte in words[3:]),
            )
            self._heard.append(message)
            self._give(message, client)
        elif words[0] in _ANSWERS:
            self._write(client, _ANSWERS[words[0]])

    def _give(self, message: can.Message, sender: socket.socket | None) -> None:
        width = 8 if message.is_extended_id else 3
        text = f"< frame {message.arbitration_id:0{width}X} {time.time():.6f} {message.data.hex()} >".encode()
        for client in [each for each in self._clients if each is not sender]:
            self._write(client, text)

    def _write(self, client: socket.socket, text: bytes) -> None:
        try:
            client.sendall(text)
        except OSError:
            self._lose(client)

    def _lose(self, client: socket.socket) -> None:
        self._clients.pop(client, None)
        client.close()
