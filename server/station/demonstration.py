"""Whether the demonstration's own sensors may be heard: they are silent while others send."""

from __future__ import annotations

from fusion.messages import Packet, SkeletonSample

ADDRESSES = ("127.0.1.1", "127.0.1.2")
"""Where the demonstration's two sensors send from."""
QUIET_S = 30.0
"""Others must be silent for so long, and no session of theirs be open, before the demonstration comes back."""
REMIND_S = 0.5
"""The sensors are told again this often: one that starts late must hear it too."""


def is_ours(sender: str) -> bool:
    """Whether a stream or sensor is the demonstration's own."""
    return sender.split("/")[0] in ADDRESSES


class Demonstration:
    """Decides who is heard in demonstration mode."""

    def __init__(self) -> None:
        self._others_s: float | None = None
        self._told_s = float("-inf")

    @property
    def is_paused(self) -> bool:
        """Whether others have the floor."""
        return self._others_s is not None

    def heard(self, packets: list[Packet]) -> list[Packet]:
        """The packets to use: all, or while others have the floor only theirs."""
        if not self.is_paused:
            return packets
        return [packet for packet in packets if not is_ours(packet.stream)]

    def listen(self, samples: tuple[SkeletonSample, ...], session_open: bool, now_s: float) -> bool:
        """Notice who has sent whole frames; True where the floor has just changed hands."""
        before = self.is_paused
        if any(not is_ours(sample.sensor) for sample in samples):
            self._others_s = now_s
        elif self._others_s is not None and not session_open and now_s - self._others_s > QUIET_S:
            self._others_s = None
        return self.is_paused is not before

    def remind_now(self, now_s: float) -> bool:
        """Whether the sensors are to be told again."""
        if now_s - self._told_s < REMIND_S:
            return False
        self._told_s = now_s
        return True
