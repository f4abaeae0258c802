"""A UDP connection from this machine to itself, for measuring what the network costs."""

from __future__ import annotations

import socket

from fusion.errors import MachineError

WAIT_S = 2.0
LARGEST = 65536
BUFFER_BYTES = 1 << 20


class Loopback:
    """Datagrams over UDP on 127.0.0.1, any free port.

    Raises:
        MachineError: no such socket can be opened.
    """

    def __init__(self) -> None:
        try:
            self._in = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
            self._in.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER_BYTES)
            self._in.bind(("127.0.0.1", 0))
        except OSError as error:
            raise MachineError(f"no UDP port can be opened on 127.0.0.1: {error.strerror}", "a free port") from error
        self._in.settimeout(WAIT_S)
        self._out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._out.connect(self._in.getsockname())

    def send(self, payload: bytes) -> None:
        """Send one datagram."""
        self._out.send(payload)

    def receive(self) -> bytes:
        """The next datagram; raises MachineError where none arrives within two seconds."""
        try:
            return self._in.recv(LARGEST)
        except TimeoutError as error:
            raise MachineError("a datagram to 127.0.0.1 never arrived", "a loopback that works") from error

    def close(self) -> None:
        """Close both sockets."""
        self._in.close()
        self._out.close()
