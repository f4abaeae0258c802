"""Fuses a recording with every method and every sensor alone, and scores each run against the truth."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from fusion.errors import RecordingError
from fusion.evaluation.angle_scores import AngleErrors, AngleScore, angle_errors, joined_angles, score_angles
from fusion.evaluation.scores import Errors, Score, errors_of, joined, score, truth_at
from fusion.messages import Floats
from fusion.offline import FusedRecording, fuse_recording
from fusion.recording.recording import Recording, Trouble, TruthStream
from fusion.skeleton import JOINTS, Side, arm

SETTLE_S = 2.0
"""Not scored: filters settle and bones are learnt."""
SENSOR_METHOD = "average"
"""A sensor alone is its own latest sample, held where it sees nothing."""
Progress = Callable[[float], None]


@dataclass(frozen=True, slots=True)
class Way:
    """One way to fuse a recording."""

    name: str
    method: str
    causal: bool = False
    """Alignment learnt on the way, as live; else from the whole recording first."""
    only_sensor: str | None = None


@dataclass(frozen=True, slots=True)
class Run:
    """What one way came to."""

    way: Way
    joints: dict[str, Score]
    """By joint name, in skeleton order: those that have truth and were ever seen."""
    healthy_arm: Score
    """Shoulder, elbow and wrist together."""
    healthy_arm_errors: Errors
    angles: dict[str, AngleScore]
    """The healthy arm's, by the names of `angle_scores.ROWS`; empty where the true trunk or arm is not known."""
    angle_errors: AngleErrors


@dataclass(frozen=True, slots=True)
class Evaluation:
    """All runs over one recording."""

    recording: str
    healthy_side: Side
    runs: tuple[Run, ...]


def ways_of(recording: Recording, methods: Sequence[str]) -> tuple[Way, ...]:
    """Every method with the alignment known first and with it learnt on the way; then every sensor alone."""
    sensors = [stream.sensor for stream in recording.skeleton_streams if stream.samples]
    return (
        *(Way(method, method) for method in methods),
        *(Way(method, method, causal=True) for method in methods),
        *(Way(f"{sensor} alone", SENSOR_METHOD, only_sensor=sensor) for sensor in sensors),
    )


def evaluate_recording(
    recording: Recording, ways: Sequence[Way], progress: Progress = lambda share: None
) -> Evaluation:
    """Fuse in every one of the ways and score against the truth.

    Args:
        recording: with truth for its joints.
        ways: see `ways_of`.
        progress: told the share done, 0 to 1.

    Raises:
        RecordingError: there is no truth, or none for the healthy arm.
        InputError: a method is not known.
    """
    truth = _truth(recording)
    runs = []
    for k, way in enumerate(ways):
        fused = fuse_recording(recording, way.method, causal=way.causal, only_sensor=way.only_sensor)
        runs.append(_scored(way, fused, truth, recording.events))
        progress((k + 1) / len(ways))
    return Evaluation(recording.name, _side(recording), tuple(runs))


def pooled(evaluations: Sequence[Evaluation]) -> dict[Way, Score]:
    """The healthy arm over all recordings together, by way, in the order of the runs."""
    by_way: dict[Way, list[Errors]] = {}
    for evaluation in evaluations:
        for run in evaluation.runs:
            by_way.setdefault(run.way, []).append(run.healthy_arm_errors)
    return {way: score(joined(parts)) for way, parts in by_way.items()}


def pooled_angles(evaluations: Sequence[Evaluation]) -> dict[Way, dict[str, AngleScore]]:
    """The healthy arm's angles over all recordings together, by way, in the order of the runs."""
    by_way: dict[Way, list[AngleErrors]] = {}
    for evaluation in evaluations:
        for run in evaluation.runs:
            by_way.setdefault(run.way, []).append(run.angle_errors)
    return {way: score_angles(joined_angles(parts)) for way, parts in by_way.items()}


def _truth(recording: Recording) -> TruthStream:
    if recording.truth is None:
        raise RecordingError(
            f"recording '{recording.name}' has no truth to compare with",
            "a stream of kind 'truth' in its recording.json",
            "evaluate a recording with truth, or use 'mirrorlimb fuse' for this one",
        )
    return recording.truth


def _side(recording: Recording) -> Side:
    return recording.healthy_side or Side.RIGHT


def _scored(way: Way, fused: FusedRecording, truth: TruthStream, events: tuple[Trouble, ...]) -> Run:
    settled = fused.t_s >= fused.t_s[0] + SETTLE_S
    true_positions = truth_at(truth, fused.t_s)
    errors = [_joint_errors(fused, true_positions, settled, joint) for joint in range(len(JOINTS))]
    healthy = joined([errors[joint] for joint in arm(fused.healthy_side)[:3]])
    if not len(healthy.distance_m):
        raise RecordingError(
            f"recording '{fused.name}' has no truth for the healthy arm after its first {SETTLE_S:g} s",
            "true positions of shoulder, elbow and wrist while the sensors saw them",
            "check its truth stream and 'healthy_side'",
        )
    joints = {JOINTS[joint]: score(found) for joint, found in enumerate(errors) if len(found.distance_m)}
    angles = angle_errors(fused.healthy, true_positions, fused.t_s, fused.healthy_side, events, settled)
    return Run(way, joints, score(healthy), healthy, score_angles(angles), angles)


def _joint_errors(fused: FusedRecording, truth: Floats, settled: np.ndarray, joint: int) -> Errors:
    return errors_of(
        truth[:, joint], fused.positions[:, joint], fused.bound_m[:, joint], fused.state[:, joint], settled
    )
