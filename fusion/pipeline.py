"""The whole idea: samples go in as they come; the fused body, its angles and the mirrored target come out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from fusion.align.alignment import SensorAlignment, reference_alignment
from fusion.align.bodies import Expected, Verdict, trunk_centre
from fusion.align.identity import BodyInView, PatientFinder
from fusion.align.learner import EVERY_S
from fusion.align.mend import Mending, SideKeeper
from fusion.align.watch import SensorWatch
from fusion.errors import InputError
from fusion.estimation import METHODS
from fusion.estimation.estimator import Estimator
from fusion.joined.estimator import Joined
from fusion.joined.evidence import Evidence
from fusion.kinematics.follower import ArmFollower
from fusion.messages import (
    AlignedSample,
    FusedFrame,
    PipelineFrame,
    SensorQuality,
    SkeletonSample,
)
from fusion.rewind import RewindingEstimator
from fusion.skeleton import Side

ENOUGH_TO_REFER_S = 0.5
"""A sensor that has shown a body for this long may become the reference."""
STALE_AFTER_S = 0.5
"""Without any sample for this long the body is not told any more."""


@dataclass(frozen=True, slots=True)
class PipelineSettings:
    """What the pipeline is told beforehand."""

    healthy_side: Side
    method: str = "set-membership"
    reference: str | None = None
    """The sensor whose frame is the room's; None takes the first that shows a body for half a second."""
    alignments: Mapping[str, SensorAlignment] | None = None
    """Known alignment of every sensor but the reference, own clocks counting; None learns them on the way."""
    evidence: Evidence | None = None
    """What inertial sensors and a tag say, on the reference's clock; None where there are none."""

    def estimator(self) -> Estimator:
        """The method's estimator, joined with the other evidence where there is any."""
        method = METHODS[self.method]
        return method() if self.evidence is None else Joined(method, self.evidence)


class Pipeline:
    """Joins what several sensors see of one patient.

    Time is the monotonic receive clock where alignments are learnt, and the reference's own clock where they are given.

    Raises:
        InputError: the method is not known.
    """

    def __init__(self, settings: PipelineSettings) -> None:
        if settings.method not in METHODS:
            raise InputError(f"no method is called '{settings.method}'", f"one of {', '.join(METHODS)}")
        self._settings = settings
        self._reference = settings.reference
        self._sensors: dict[str, SensorWatch] = {}
        self._patient = PatientFinder()
        self._sides = SideKeeper()
        self._body = RewindingEstimator(settings.estimator)
        self._arm = ArmFollower(settings.healthy_side)
        self._recent: FusedFrame | None = None
        self._latest: dict[str, AlignedSample] = {}
        self._newest_received_s = float("nan")
        self._next_learning_s = -np.inf

    def take(self, sample: SkeletonSample) -> None:
        """Take one body of one frame; samples of different sensors may come in any order."""
        watch = self._watch(sample.sensor)
        t_s = watch.receive(sample)
        verdict = self._patient.judge(sample, t_s, lambda: self._expected(watch, t_s))
        if verdict is not Verdict.PATIENT:
            watch.refusals[verdict.value] += 1
            return
        alignment = self._alignment(watch)
        if alignment is None:
            watch.refusals["not aligned yet" if watch.fault is None else watch.fault.what] += 1
            return
        aligned = alignment.apply(sample, t_s - alignment.clock_offset_s)
        centre = trunk_centre(aligned.positions_in_room, aligned.state)
        if not self._patient.agrees(sample.sensor, aligned.t_s, centre, lambda: self._expected(watch, t_s)):
            watch.refusals[Verdict.FAR.value] += 1
            return
        mended, what = self._sides.mend(aligned)
        refused = self._body.take(mended)
        self._account(watch, sample, what, refused)
        self._latest[sample.sensor] = mended
        if refused is not None:
            self._newest_received_s = max(sample.t_received_s, self._newest_received_s)  # NaN is no larger

    def step(self, t_s: float, of_sensors: bool = True) -> PipelineFrame:
        """Everything that can be said at `t_s` from what has been taken so far.

        Args:
            t_s: the instant.
            of_sensors: whether to tell how each sensor does as well.
        """
        self._learn(t_s)
        fused = self._fresh(t_s)
        samples = tuple(self._latest.values())
        arm = self._arm.follow(fused, samples)
        return PipelineFrame(
            t_s=t_s,
            sensors=self.sensors(t_s) if of_sensors else (),
            samples=samples,
            fused=fused,
            trunk=arm.trunk,
            lengths=arm.lengths,
            healthy=arm.healthy,
            target=arm.target,
            newest_received_s=self._newest_received_s,
        )

    def follow(self, sensor: str, body: str) -> bool:
        """A person's choice: this body of this sensor is the patient. Tells whether it is another one than before."""
        is_another = self._patient.follow(sensor, body)
        if is_another:
            self._body.restart()
            self._sides = SideKeeper()
            self._arm = ArmFollower(self._settings.healthy_side)
            self._recent = None
        return is_another

    def treat(self, healthy_side: Side) -> None:
        """A session begins: this arm is the healthy one. What has been learnt of the sensors stays."""
        self._settings = replace(self._settings, healthy_side=healthy_side)
        self._patient.begin_session()
        self._arm = ArmFollower(healthy_side)

    def fused_at(self, t_s: float) -> FusedFrame | None:
        """The body at `t_s`, however long nobody has seen it; None before the first sample."""
        newest_s = self._body.newest_s
        return None if newest_s is None else self._body.frame(max(t_s + self.lead_s, newest_s))

    def bodies(self, t_s: float) -> tuple[BodyInView, ...]:
        """Everybody whom a sensor sees now, the patient included, on the receive clock."""
        return tuple(self._placed(seen) for seen in self._patient.bodies(t_s))

    def sensors(self, t_s: float) -> tuple[SensorQuality, ...]:
        """How each sensor does."""
        reference = self._sensors.get(self._reference or "")
        lead_s = self.lead_s
        return tuple(watch.quality(t_s, reference, lead_s) for watch in self._sensors.values())

    @property
    def lead_s(self) -> float:
        """How far a faster sensor is ahead of the reference: the patient's present is what the fastest one sees."""
        if self._settings.alignments is not None:
            return 0.0
        return max((0.0 - found.clock_offset_s for found in self.alignments().values()), default=0.0)

    def alignments(self) -> dict[str, SensorAlignment]:
        """The alignment of every sensor that has one, the reference included."""
        found = {name: self._alignment(watch) for name, watch in self._sensors.items()}
        return {name: alignment for name, alignment in found.items() if alignment is not None}

    def refusals(self) -> dict[str, dict[str, int]]:
        """Frames and joints not used so far, by sensor and reason."""
        return {name: dict(watch.refusals) for name, watch in self._sensors.items()}

    # --- the steps

    def _placed(self, seen: BodyInView) -> BodyInView:
        alignment = self._alignment(self._sensors[seen.sensor])
        if alignment is None:
            return seen
        in_room = seen.centre_in_sensor @ alignment.rotation_sensor_to_reference.T + alignment.translation_m
        return replace(seen, centre_in_room=in_room)

    def _watch(self, sensor: str) -> SensorWatch:
        watch = self._sensors.get(sensor)
        if watch is None:
            watch = self._sensors[sensor] = SensorWatch(sensor, self._given(sensor))
        return watch

    def _given(self, sensor: str) -> SensorAlignment | None:
        if self._settings.alignments is None:
            return None
        return reference_alignment() if sensor == self._reference else self._settings.alignments.get(sensor)

    def _alignment(self, watch: SensorWatch) -> SensorAlignment | None:
        if watch.fault is not None:
            return None
        return reference_alignment() if watch.sensor == self._reference else watch.alignment

    def _expected(self, watch: SensorWatch, t_s: float) -> Expected | None:
        """Where this sensor should see the patient."""
        alignment, body, newest_s = self._alignment(watch), self._recent, self._body.newest_s
        if alignment is None or body is None or newest_s is None:
            return None
        centre = trunk_centre(body.positions_in_room, body.state)
        if not np.isfinite(centre).all():
            return None
        in_sensor = (centre - alignment.translation_m) @ alignment.rotation_sensor_to_reference
        return Expected(in_sensor, max(t_s - alignment.clock_offset_s - newest_s, 0.0))

    def _account(self, watch: SensorWatch, sample: SkeletonSample, what: Mending, refused: object) -> None:
        if refused is None:
            watch.refusals["came too late"] += 1
        for refusal in refused if isinstance(refused, tuple) else ():
            watch.refusals[refusal.reason] += 1
        if what is not Mending.NONE:
            watch.refusals[what.value] += 1
        watch.note(sample, len(refused) if isinstance(refused, tuple) else 0, what is not Mending.NONE)

    def _learn(self, t_s: float) -> None:
        """Learn alignments on the way, a few times a second."""
        if self._settings.alignments is not None or t_s < self._next_learning_s:
            return
        self._next_learning_s = t_s + EVERY_S
        for name, watch in self._sensors.items():
            watch.check(self._patient.followed(name))
        self._elect()
        reference = self._sensors.get(self._reference or "")
        track = reference.track(self._patient.followed(reference.sensor)) if reference else None
        if track is None:
            return
        for name, watch in self._sensors.items():
            if watch is not reference and watch.fault is None:
                self._patient.prefer(name, watch.learn(track, self._patient.followed(name)), t_s)

    def _elect(self) -> None:
        """The reference is the first sensor that has shown a body long enough and can be right."""
        reference = self._sensors.get(self._reference or "")
        if reference is not None and reference.fault is not None:
            self._reference = None
            self._body.restart()
            self._sides = SideKeeper()
            for watch in self._sensors.values():
                watch.forget()
        if self._reference is None:
            able = (n for n, w in self._sensors.items() if w.fault is None and self._shown_s(w) >= ENOUGH_TO_REFER_S)
            self._reference = next(able, None)

    def _shown_s(self, watch: SensorWatch) -> float:
        return watch.seen_for_s(self._patient.followed(watch.sensor))

    def _fresh(self, t_s: float) -> FusedFrame | None:
        """The body, unless nobody has seen or felt it for too long."""
        fused = self.fused_at(t_s)
        newest_s = self._body.newest_s
        if fused is None or newest_s is None or (fused.t_s - newest_s > STALE_AFTER_S and not self._goes_on(fused.t_s)):
            return None
        self._recent = fused
        return fused

    def _goes_on(self, t_s: float) -> bool:
        """Whether other sensors than cameras follow the body."""
        evidence = self._settings.evidence
        return evidence is not None and evidence.speaks(t_s)
