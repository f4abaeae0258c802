"""Where a replay stands: a clock that can be stopped, set, and made to run faster or slower."""

from __future__ import annotations

from dataclasses import dataclass, replace


@dataclass(frozen=True, slots=True)
class ReplayClock:
    """A position that moves by itself while it plays. Times in seconds; `now_s` is any monotonic clock."""

    duration_s: float
    since_s: float
    """When (on the monotonic clock) it stood at `t_s`."""
    t_s: float = 0.0
    """Position in the session at `since_s`."""
    playing: bool = False
    speed: float = 1.0

    def at(self, now_s: float) -> float:
        """The position now; it stays at the end."""
        gone_s = (now_s - self.since_s) * self.speed if self.playing else 0.0
        return min(max(self.t_s + gone_s, 0.0), self.duration_s)

    def plays(self, now_s: float) -> bool:
        """Whether it still moves."""
        return self.playing and self.at(now_s) < self.duration_s

    def changed(self, now_s: float, t_s: float | None, playing: bool, speed: float) -> ReplayClock:
        """The same clock from now on; where no position is given it goes on from where it stands."""
        here_s = self.at(now_s) if t_s is None else min(t_s, self.duration_s)
        return replace(self, since_s=now_s, t_s=here_s, playing=playing, speed=speed)
