"""From a session's recording to its figures and its curves. Reads whole files: run it in a worker thread."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import nan
from pathlib import Path

import numpy as np

from db.therapy_session import MetricBase
from fusion.messages import Floats
from fusion.metrics.metric import Metric
from fusion.metrics.record import Attempt, DriveTrack, SensorTrack, SessionRecord
from fusion.metrics.session import session_metrics
from fusion.skeleton import Side
from server.api.forms import Curves, JointCurves
from server.api.recorded import RecordedTick, read_ticks
from server.messages import EXO_JOINTS

CURVE_POINTS = 1500
"""More than a screen is wide."""


@dataclass(frozen=True, slots=True)
class Counts:
    """What was counted while the session lasted."""

    hits: int = 0
    misses: int = 0
    pain_calls: int = 0
    """How often somebody said that it hurts."""
    attempts: tuple[Attempt, ...] = ()
    """Of all games, in order."""


def measure(recording: Path, healthy_side: Side, counts: Counts) -> list[MetricBase]:
    """The figures of a session.

    Raises:
        RecordingError: the recording cannot be read, or holds no tick.
    """
    return [_row(metric) for metric in session_metrics(session_record(read_ticks(recording), healthy_side, counts))]


def session_record(ticks: Sequence[RecordedTick], healthy_side: Side, counts: Counts) -> SessionRecord:
    """A session's ticks as the arrays that metrics are made of."""
    return SessionRecord(
        t_s=np.array([tick.t_s for tick in ticks]),
        state=np.array([tick.state.value for tick in ticks]),
        healthy_side=healthy_side,
        healthy_rad=_healthy_rad(ticks),
        healthy_valid=np.array([tick.healthy is not None and tick.healthy.valid for tick in ticks]),
        affected_rad=np.array([tick.exo.angle_rad for tick in ticks]),
        hand_in_trunk=_rows([None if tick.healthy is None else tick.healthy.points_in_trunk[3] for tick in ticks], 3),
        trunk_displacement_m=np.array([tick.trunk_lean_m for tick in ticks]),
        sensors=tuple(_track(name, ticks) for name in sorted({s.sensor for tick in ticks for s in tick.sensors})),
        hits=counts.hits,
        misses=counts.misses,
        pain_calls=counts.pain_calls,
        drive=_drive(ticks),
        shoulder_hitch_m=_hitch_m(ticks),
        attempts=counts.attempts,
    )


def _hitch_m(ticks: Sequence[RecordedTick]) -> Floats | None:
    told = [tick.shoulder_hitch_m for tick in ticks if tick.shoulder_hitch_m is not None]
    return np.array(told) if len(told) == len(ticks) else None


def _drive(ticks: Sequence[RecordedTick]) -> DriveTrack | None:
    exos = [tick.exo for tick in ticks]
    if not all(len(exo.interaction_nm) == len(exo.share) == len(EXO_JOINTS) for exo in exos):
        return None
    return DriveTrack(
        velocity_rad_s=np.array([exo.velocity_rad_s for exo in exos]),
        torque_nm=np.array([exo.torque_nm for exo in exos]),
        interaction_nm=np.array([exo.interaction_nm for exo in exos]),
        share=np.array([exo.share for exo in exos]),
        assistance=np.array([exo.assistance.value for exo in exos]),
        level=np.array([exo.level for exo in exos]),
    )


def read_curves(recording: Path, is_over: bool) -> Curves:
    """A session's curves; kept beside the recording once the session is over.

    Raises:
        RecordingError: the recording cannot be read, or holds no tick.
    """
    kept = recording.with_suffix(".curves.json")
    if kept.is_file():
        return Curves.model_validate_json(kept.read_bytes())
    curves = thin_curves(read_ticks(recording))
    if is_over:
        kept.write_text(curves.model_dump_json(), encoding="utf-8")
    return curves


def thin_curves(ticks: Sequence[RecordedTick]) -> Curves:
    """At most `CURVE_POINTS` points, evenly taken."""
    chosen = [ticks[i] for i in np.linspace(0, len(ticks) - 1, min(len(ticks), CURVE_POINTS)).astype(int)]
    return Curves(
        t_s=[round(tick.t_s - ticks[0].t_s, 3) for tick in chosen],
        healthy_rad=_joint_curves(_healthy_rad(chosen)),
        affected_rad=_joint_curves(np.array([tick.exo.angle_rad for tick in chosen])),
        state=[tick.state for tick in chosen],
    )


def _healthy_rad(ticks: Sequence[RecordedTick]) -> Floats:
    return _rows(
        [
            (arm.plane_rad, arm.elevation_rad, arm.rotation_rad, arm.elbow_rad)
            if (arm := tick.healthy) is not None and arm.valid
            else None
            for tick in ticks
        ],
        len(EXO_JOINTS),
    )


def _rows(rows: Sequence[tuple[float, ...] | None], width: int) -> Floats:
    return np.array([(nan,) * width if row is None else row for row in rows], float).reshape(-1, width)


def _track(name: str, ticks: Sequence[RecordedTick]) -> SensorTrack:
    views = [next((view for view in tick.sensors if view.sensor == name), None) for tick in ticks]
    return SensorTrack(
        name=name,
        frames_per_s=np.array([nan if view is None else view.frames_per_s for view in views]),
        residual_m=np.array([nan if view is None or view.residual_m is None else view.residual_m for view in views]),
        age_s=np.array([nan if view is None else view.age_s for view in views]),
    )


def _joint_curves(angles_rad: Floats) -> JointCurves:
    columns = {joint: [_rounded(value) for value in angles_rad[:, k]] for k, joint in enumerate(EXO_JOINTS)}
    return JointCurves.model_validate(columns)


def _rounded(value: float) -> float | None:
    return round(float(value), 4) if np.isfinite(value) else None


def _row(metric: Metric) -> MetricBase:
    return MetricBase(
        name=metric.name,
        joint=metric.joint or "",
        side=metric.side or "",
        value=metric.value,
        sem=metric.sem,
        unit=metric.unit,
        label=metric.label_key,
        caveat=metric.caveat_key or "",
    )
