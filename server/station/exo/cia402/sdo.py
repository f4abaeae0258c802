"""A node's objects, read and written one at a time; what it refuses is said in words that name joint, node and key."""

from __future__ import annotations

import struct
from dataclasses import dataclass

from canopen.sdo.client import SdoClient
from canopen.sdo.exceptions import SdoAbortedError, SdoCommunicationError

from fusion.errors import MachineError
from server.exoskeleton import ExoskeletonJoint
from server.station.exo.cia402.objects import Entry

_NO_OBJECT, _NO_SUBINDEX = 0x06020000, 0x06090011


@dataclass(frozen=True, slots=True)
class Place:
    """Where a joint stands in the exoskeleton file and on the bus."""

    index: int
    joint: ExoskeletonJoint

    def __str__(self) -> str:
        return f"The joint '{self.joint.name}' (joints[{self.index}].node = {self.joint.node})"

    def key(self, name: str) -> str:
        """A key of its table in the exoskeleton file."""
        return f"joints[{self.index}].{name}"


class Parameters:
    """One node's objects. Every call waits for the node: never in a tick.

    Args:
        place: of its joint.
        client: its parameter channel.
    """

    def __init__(self, place: Place, client: SdoClient) -> None:
        self.place, self._client = place, client

    def read(self, entry: Entry) -> int:
        """The value that the node has.

        Raises:
            MachineError: it does not answer or refuses.
        """
        try:
            return entry.decoded(self._client.upload(entry.index, entry.sub))
        except SdoCommunicationError:
            raise self._absent(entry) from None
        except (SdoAbortedError, struct.error) as error:
            raise MachineError(f"{self.place} does not tell its {entry}: {error}", "a CiA 402 drive") from None

    def write(self, entry: Entry, value: int) -> None:
        """Give the node a value.

        Raises:
            MachineError: it does not answer or refuses, or the value does not fit.
        """
        try:
            self._client.download(entry.index, entry.sub, entry.encoded(value))
        except SdoCommunicationError:
            raise self._absent(entry) from None
        except (SdoAbortedError, struct.error) as error:
            raise MachineError(f"{self.place} does not take {value} as its {entry}: {error}") from None

    def has(self, entry: Entry) -> bool:
        """Whether the node knows an object that not every drive has.

        Raises:
            MachineError: it does not answer.
        """
        try:
            self._client.upload(entry.index, entry.sub)
        except SdoCommunicationError:
            raise self._absent(entry) from None
        except SdoAbortedError as error:
            return error.code not in (_NO_OBJECT, _NO_SUBINDEX)
        return True

    def set(self, entry: Entry, value: int, key: str) -> None:
        """Write a value that safety stands on, and read it back.

        Raises:
            MachineError: the node did not take it; names the file's key and what was expected.
        """
        self.write(entry, value)
        self.expect(entry, value, key)

    def expect(self, entry: Entry, value: int, key: str) -> None:
        """Compare what the node has with what the file says.

        Raises:
            MachineError: they differ; names the file's key and what was expected.
        """
        found = self.read(entry)
        if found != value:
            raise MachineError(
                f"{self.place}: its {entry} reads {found}", f"{value}, from {key}", "mend the file or the drive's setup"
            )

    def _absent(self, entry: Entry) -> MachineError:
        return MachineError(
            f"{self.place} does not answer (asked for its {entry})",
            f"a CANopen node {self.place.joint.node}, powered, at the bit rate of cia402.bitrate",
            "check supply, cable, terminators, node number and bit rate",
        )
