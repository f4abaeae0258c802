"""A recording played to a cranked station with the simulated exoskeleton: what was wished, commanded and done."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from fusion.align.whole import align_streams
from fusion.arrival import as_if_equally_quick
from fusion.errors import MachineError, RecordingError
from fusion.evaluation.scores import truth_at
from fusion.formats.registry import dialect_named
from fusion.kinematics.angles import ARM_JOINTS, OUTWARD, arm_pose, direction_from_swing, forearm_from_twist
from fusion.kinematics.body_frame import trunk_frame
from fusion.messages import Flags, Floats, Packet
from fusion.recording.recording import Recording, TruthStream
from fusion.skeleton import Side
from server.config import StationConfig
from server.experiments.cranked.station import DT_S, IN_CHARGE, CrankedStation
from server.messages import EXO_JOINTS, DriveState, Enable, LiveTick, OpenSession, Resume
from server.sender import departures, duration_s
from server.station.exo.simulated import SimulatedDrive
from server.station.exo.simulated_arm.person import HumanArm

DIALECT: Final = dialect_named("kinectv2-osc")
ADDRESSES: Final = ("sensor-1", "sensor-2")
FRAME_S: Final = 1 / 30
START_EVERY_S: Final = 0.2
"""The therapist tries to start so often."""
RESUME_AFTER_S: Final = 2.5
"""The therapist looks on for so long before ending a hold: a short one may end by itself within two seconds (SR-5)."""
UNKNOWN: Final = (float("nan"),) * len(EXO_JOINTS)


@dataclass(frozen=True, slots=True)
class Course:
    """What happened, tick by tick; angles are the four anatomical ones, places the third knuckle's in limb coordinates
    (outward, up, back) as seen from the shoulder.
    """

    t_s: Floats  # (T,) since the recording began
    state: tuple[DriveState, ...]  # (T,)
    following: Flags  # (T,) engaged, the blend-in done
    truth_rad: Floats  # (T, 4) of the healthy arm, mirrored; NaN where there is no truth
    truth_m: Floats  # (T, 3) where the hand should be
    target_rad: Floats  # (T, 4) what the sensors said; NaN where nothing
    commanded_rad: Floats  # (T, 4)
    measured_rad: Floats  # (T, 4) by the motors
    arm_rad: Floats  # (T, 4) of the arm in the exoskeleton
    arm_m: Floats  # (T, 3) where its hand is
    interaction_nm: Floats  # (T, 4) what the drive takes for the arm's own doing
    resumed_by_person: int
    """How often a person had to say that it may go on."""


def on_one_clock(recording: Recording) -> Recording:
    """The recording with every sensor's stamps on the first one's clock, received when taken.

    Raises:
        RecordingError: its sensors' clocks cannot be compared.
    """
    streams = recording.skeleton_streams
    origin = next(stream for stream in streams if stream.primary)
    due = as_if_equally_quick(streams, origin, align_streams(streams, origin.sensor))
    samples = [replace(each.sample, t_s=each.t_s) for each in due]
    told = tuple(replace(s, samples=tuple(one for one in samples if one.sensor == s.sensor)) for s in streams)
    return replace(recording, skeleton_streams=told)


def played(
    recording: Recording, learn_s: float, rounds: int = 1, progress: Callable[[float], None] = lambda share: None
) -> Course:
    """Play a recording; the therapist starts after `learn_s` as soon as it is possible, and has every hold end.

    Args:
        recording: with truth, on one clock.
        learn_s: for how long the station only watches.
        rounds: how often it is played, one after the other.
        progress: told the share done.

    Raises:
        RecordingError: there is no truth.
        MachineError: the exoskeleton could not be started.
    """
    if recording.truth is None or recording.healthy_side is None:
        raise RecordingError(f"'{recording.name}' has no truth", "a recording with truth and a healthy side")
    play = _Play(recording, recording.healthy_side)
    round_s = duration_s(recording) + FRAME_S
    ticks = int((rounds * round_s - FRAME_S) / DT_S)
    for tick in range(ticks):
        play.tick((tick + 1) * DT_S, learn_s)
        if tick % 100 == 0:
            progress(tick / ticks)
    if DriveState.ENGAGED not in play.states:
        raise MachineError(" ".join(play.last.blockers) or play.last.reason)
    return play.course(
        *mirrored_truth(recording.truth, recording.healthy_side, _truth_times(recording, ticks, round_s))
    )


def mirrored_truth(truth: TruthStream, side: Side, t_s: Floats) -> tuple[Floats, Floats]:
    """The healthy arm's true angles (T, 4), which are the mirrored arm's, and where that arm's hand belongs (T, 3).

    The hand is that of the arm in the exoskeleton, with its lengths.
    """
    angles, places = np.full((len(t_s), 4), np.nan), np.full((len(t_s), 3), np.nan)
    for k, positions in enumerate(truth_at(truth, t_s)):
        trunk = trunk_frame(positions)
        if trunk is None:
            continue
        pose = arm_pose(positions, trunk.rotation_trunk_to_room, OUTWARD[side], ARM_JOINTS[side])
        angles[k] = pose.plane, pose.elevation, pose.twist, pose.flexion
        places[k] = hand_m(angles[k])
    return angles, places


def hand_m(angle_rad: Floats) -> Floats:
    """(3,) the knuckle of the simulated arm at anatomical angles (4,), in limb coordinates from the shoulder."""
    plane, elevation, twist, flexion = angle_rad.tolist()
    upper_m, forearm_m, knuckle_m = HumanArm().lengths_m
    upper = direction_from_swing(plane, elevation)
    place: Floats = upper_m * upper + (forearm_m + knuckle_m) * forearm_from_twist(upper, twist, flexion)
    return place


def _truth_times(recording: Recording, ticks: int, round_s: float) -> Floats:
    first_s = min(stream.samples[0].t_received_s for stream in recording.skeleton_streams if stream.samples)
    since: Floats = np.mod((np.arange(ticks) + 1) * DT_S, round_s)
    return first_s + since


class _Play:
    """A station, a drive, and who is before it."""

    def __init__(self, recording: Recording, healthy_side: Side) -> None:
        config = StationConfig()
        self._limits, self._side = config.device, healthy_side
        self._drive = SimulatedDrive(config.exoskeleton)
        self._station = CrankedStation(config, self._drive)
        self._began_s = self._station.now_s
        self._leaving = departures(recording, loop=True)
        self._next = next(self._leaving)
        self._changed_s, self.resumed = 0.0, 0
        self.states: list[DriveState] = []
        self._rows: list[tuple[object, ...]] = []
        self.last = self._open()

    def _open(self) -> LiveTick:
        number = self._station.wish(
            OpenSession,
            session="1",
            patient="virtual",
            healthy_side=self._side,
            side_confirmed=True,
            limits=self._limits,
            limits_set_by=IN_CHARGE,
            recording="",
        )
        tick, answer = self._station.step(), self._station.answer(number)
        if not answer.accepted:
            raise MachineError(f"no session can be opened: {answer.reason}")
        return tick

    def tick(self, after_s: float, learn_s: float) -> None:
        for packet in self._arriving(after_s):
            self._station.source.waiting.append(packet)
        before = self.last.state
        waits_s = {DriveState.READY: START_EVERY_S, DriveState.HOLD: RESUME_AFTER_S}.get(before, float("inf"))
        if after_s > learn_s and after_s - self._changed_s > waits_s:
            self._go_on(after_s)
        else:
            self.last = self._station.step()
        if self.last.state is not before:
            self._changed_s = after_s
        self._note(after_s)

    def _go_on(self, after_s: float) -> None:
        number = self._station.wish(Enable if self.last.state is DriveState.READY else Resume)
        self.last = self._station.step()
        self._changed_s = after_s
        self.resumed += self._station.answer(number).accepted

    def _arriving(self, after_s: float) -> Iterator[Packet]:
        while self._next.after_s <= after_s:
            leaving = self._next
            for datagram in DIALECT.encode(leaving.sample, 0):
                yield Packet(ADDRESSES[leaving.sensor], self._began_s + leaving.after_s, datagram)
            self._next = next(self._leaving)

    def _note(self, after_s: float) -> None:
        tick, target = self.last, self.last.target
        self.states.append(tick.state)
        self._rows.append(
            (
                after_s,
                tick.state is DriveState.ENGAGED and tick.exo.blend >= 1.0,
                (target.plane_rad, target.elevation_rad, target.rotation_rad, target.elbow_rad) if target else UNKNOWN,
                tick.exo.command_rad,
                tick.exo.angle_rad,
                self._drive.scene.arm_rad(),
                self._drive.scene.hand_m(),
                tick.exo.interaction_nm,
            )
        )

    def course(self, truth_rad: Floats, truth_m: Floats) -> Course:
        columns = [np.array(column) for column in zip(*self._rows, strict=True)]
        t_s, following, target, commanded, measured, arm, hand, interaction = columns
        return Course(
            t_s=t_s,
            state=tuple(self.states),
            following=following,
            truth_rad=truth_rad,
            truth_m=truth_m,
            target_rad=target,
            commanded_rad=commanded,
            measured_rad=measured,
            arm_rad=arm,
            arm_m=hand,
            interaction_nm=interaction,
            resumed_by_person=self.resumed - 1,
        )
