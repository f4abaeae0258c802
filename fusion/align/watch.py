"""What is known live of one sensor: its clock, its recent frames, its alignment, and what a therapist should hear."""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter, deque

import numpy as np

from fusion.align.alignment import SensorAlignment
from fusion.align.learner import FEWEST_FRAMES, WINDOW_S, AlignmentLearner
from fusion.align.plausible import Fault, feet_fault, unit_fault
from fusion.align.timeline import ReceiveClock
from fusion.align.track import BodyTrack
from fusion.messages import SensorQuality, SkeletonSample
from fusion.skeleton import TrackingState

RATE_OVER_S = 2.0
SILENT_AFTER_S = 0.5
OTHERS_CLEARLY_WORSE = 1.3
"""With several people in view, the body that is followed must fit the reference's this much better than any other."""
ONE_FRAME_S = 0.012
"""Bodies of one frame come within this, one datagram after the other, and count as one; a frame closes after it."""
RECENT_MENDS = 60
OFTEN = 0.5

TRACKED = int(TrackingState.TRACKED)
FEET_FRAMES = 150
"""Frames of the window, evenly, that show which way the toes point."""

Frames = deque[tuple[float, SkeletonSample]]


class SensorWatch:
    """One sensor as it is heard live.

    Args:
        sensor: its name.
        given: its alignment where that is known beforehand; then nothing is learnt and its own clock counts.
    """

    def __init__(self, sensor: str, given: SensorAlignment | None = None) -> None:
        self.sensor = sensor
        self.clock = ReceiveClock()
        self.fault: Fault | None = None
        self.refusals: Counter[str] = Counter()
        """Frames and joints not used so far, by reason."""
        self._given = given
        self._frames: dict[str, Frames] = {}
        self._times: deque[float] = deque(maxlen=120)
        self._learner: AlignmentLearner | None = None
        self._candidates: dict[str, AlignmentLearner] = {}
        """One per body, as long as it is open which of them the reference sees."""
        self._mended: deque[bool] = deque(maxlen=RECENT_MENDS)
        self._newest: SkeletonSample | None = None
        self._refused_joints = 0
        self._stacked: tuple[str, BodyTrack] | None = None
        """The track that was asked for last: it is asked for several times in a row."""

    # --- what comes in

    def receive(self, sample: SkeletonSample) -> float:
        """Take any body's sample; its time on the common clock."""
        if self._given is not None:
            t_s = sample.t_s
        else:
            t_s = self.clock.on_receive_clock(sample.t_s, sample.t_received_s)
            self._remember(sample, t_s)
        if not self._times or t_s > self._times[-1] + ONE_FRAME_S:
            self._times.append(t_s)
        return t_s

    def note(self, sample: SkeletonSample, refused_joints: int, mended: bool) -> None:
        """Remember what became of the patient's sample."""
        self._newest = sample
        self._refused_joints = refused_joints
        self._mended.append(mended)

    def _remember(self, sample: SkeletonSample, t_s: float) -> None:
        frames = self._frames.setdefault(sample.body, deque())
        if not frames or t_s > frames[-1][0]:
            frames.append((t_s, sample))
        for body in list(self._frames):
            kept = self._frames[body]
            while kept and kept[0][0] < t_s - WINDOW_S:
                kept.popleft()
            if not kept:
                del self._frames[body]

    def track(self, body: str | None) -> BodyTrack | None:
        """The last seconds of a body on the receive clock; None where there are too few."""
        frames = self._frames.get(body or "")
        if body is None or frames is None or len(frames) < FEWEST_FRAMES:
            return None
        if self._stacked is None or self._stacked[0] != body or self._stacked[1].t_s[-1] != frames[-1][0]:
            self._stacked = body, _stacked(frames)
        return self._stacked[1]

    def seen_for_s(self, body: str | None) -> float:
        """How long a body has been in view, within the window."""
        frames = self._frames.get(body or "")
        return frames[-1][0] - frames[0][0] if frames else 0.0

    # --- what is learnt

    @property
    def alignment(self) -> SensorAlignment | None:
        """Where the sensor stands; None until that is well determined."""
        if self._given is not None or self.fault is not None:
            return self._given
        return self._learner.alignment if self._learner else None

    def check(self, body: str | None) -> None:
        """Look whether this sender can be right at all; handedness against the reference is looked at in `learn`."""
        track = self.track(body)
        if track is not None:
            self.fault = unit_fault(track.positions[-FEWEST_FRAMES:], track.state[-FEWEST_FRAMES:])
            self.fault = self.fault or feet_fault(track.thinned(FEET_FRAMES))

    def learn(self, reference: BodyTrack, followed: str | None) -> str | None:
        """Learn from the reference's last seconds.

        Args:
            reference: the patient's track in the reference sensor.
            followed: the body followed in this sensor; another may prove to be the patient while nothing is aligned.

        Returns:
            The body that was found to be the patient just now.
        """
        if self._learner is None:
            return self._find(reference)
        track = self.track(followed)
        if track is not None:
            self._learner.learn(reference, track)
            self.fault = self._learner.fault
        return None

    def forget(self) -> None:
        """Start learning anew, as when the reference changes."""
        self._learner = None
        self._candidates.clear()

    def _find(self, reference: BodyTrack) -> str | None:
        """Hold every body in view against the reference's; the one that agrees clearly best is the same person."""
        for body in self._frames:
            track = self.track(body)
            if track is not None:
                self._candidates.setdefault(body, AlignmentLearner()).learn(reference, track)
        able = {b: a.residual_m for b, learner in self._candidates.items() if (a := learner.alignment) is not None}
        if not able:
            self.fault = next((learner.fault for learner in self._candidates.values() if learner.fault), None)
            return None
        best, *others = sorted(able, key=lambda body: able[body])
        if others and able[others[0]] < OTHERS_CLEARLY_WORSE * able[best]:
            return None
        self._learner = self._candidates[best]
        self._candidates.clear()
        return best

    # --- what is told

    def quality(self, now_s: float, reference: SensorWatch | None, lead_s: float) -> SensorQuality:
        """What a therapist wants to know.

        Args:
            now_s: on the common clock.
            reference: the reference sensor's watch.
            lead_s: how far the fastest sensor is ahead of the reference.
        """
        found = self.alignment
        is_reference = reference is self
        return SensorQuality(
            sensor=self.sensor,
            is_reference=is_reference,
            frames_per_s=self._rate(now_s),
            latency_s=self.clock.delay_s + self._lag_s(lead_s),
            joints_tracked=_tracked(self._newest) if self._newest else 0,
            clock_offset_s=self._clock_offset(reference),
            residual_m=0.0 if is_reference else found.residual_m if found else float("nan"),
            aligned=self.fault is None and (is_reference or found is not None),
            last_seen_s=self._times[-1] if self._times else float("nan"),
            refused_joints=self._refused_joints,
            warnings=self._warnings(now_s),
        )

    def _rate(self, now_s: float) -> float:
        first = bisect_right(self._times, now_s - RATE_OVER_S)
        intervals = len(self._times) - first - 1
        return intervals / max(self._times[-1] - self._times[first], 1e-3) if intervals > 0 else 0.0

    def _lag_s(self, lead_s: float) -> float:
        """How far this sensor is behind the fastest one, as far as that is known."""
        if self._given is not None:
            return 0.0
        return lead_s + (self.alignment.clock_offset_s if self.alignment else 0.0)

    def _clock_offset(self, reference: SensorWatch | None) -> float:
        """From the sensor's own clock to the reference's own: the learnt offset and both clocks' differences."""
        if self._given is not None:
            return self._given.clock_offset_s
        if reference is None or reference is self or self.alignment is None:
            return 0.0
        return self.alignment.clock_offset_s + reference.clock.difference_s - self.clock.difference_s

    def _warnings(self, now_s: float) -> tuple[str, ...]:
        told: list[str] = []
        if self.fault is not None:
            told.append(f"{self.sensor}: {self.fault}")
        if self._times and now_s - self._times[-1] > SILENT_AFTER_S:
            told.append(f"{self.sensor}: silent. Check its cable, its program and that the patient is in view")
        if self._learner is not None and self._learner.moved:
            told.append(f"{self.sensor}: it was moved; its place is being learnt anew. Let the patient move a little")
        if len(self._mended) == RECENT_MENDS and sum(self._mended) > OFTEN * RECENT_MENDS:
            told.append(f"{self.sensor}: left and right look exchanged. Let the patient turn towards this sensor")
        return tuple(told)


def _tracked(sample: SkeletonSample) -> int:
    """How many of its joints are tracked."""
    return int(np.count_nonzero(sample.state == TRACKED))


def _stacked(frames: Frames) -> BodyTrack:
    return BodyTrack(
        np.array([t_s for t_s, _ in frames]),
        np.array([sample.positions_in_sensor for _, sample in frames]),
        np.array([sample.state for _, sample in frames]),
    )
