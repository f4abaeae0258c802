"""The open session as the station knows it, and what it still lacks before anything may move (SR-10)."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

import numpy as np

from fusion.messages import Floats, PipelineFrame
from fusion.skeleton import INDEX, Side
from server.config import GateConfig
from server.messages import JointLimits, OpenSession
from server.station.exo import patient_range
from server.station.exo.limiter import Box


@dataclass(frozen=True, slots=True)
class Session:
    """What was agreed when the session was opened."""

    name: str
    patient: str
    healthy_side: Side
    side_confirmed: bool
    limits: tuple[JointLimits, ...]
    """Inside the device's own."""
    boxes: tuple[Box, ...]
    limits_set_by: str
    recording: str


def opened(wish: OpenSession, device: tuple[JointLimits, ...], config: GateConfig) -> Session:
    """The session that a wish asks for. Its limits must be usable (`patient_range.refused`), or be missing."""
    limits = patient_range.inside_device(wish.limits, device) if wish.limits else ()
    return Session(
        name=wish.session,
        patient=wish.patient.strip(),
        healthy_side=wish.healthy_side,
        side_confirmed=wish.side_confirmed,
        limits=limits,
        boxes=patient_range.boxes(limits, config),
        limits_set_by=wish.limits_set_by.strip(),
        recording=wish.recording,
    )


def lacks(session: Session | None, frame: PipelineFrame) -> tuple[str, ...]:
    """What still forbids motion, in plain words (SR-10)."""
    if session is None:
        return ("No session is open.",)
    wanted = (
        (session.patient, "The session names no patient."),
        (session.side_confirmed, "The affected side has not been confirmed on screen."),
        (session.limits, "No limits of movement are set for this patient."),
        (session.limits_set_by, "Nobody has signed for the limits of movement."),
        (any(sensor.aligned for sensor in frame.sensors), "No sensor is aligned yet."),
    )
    return tuple(words for is_there, words in wanted if not is_there)


def lean_m(at_enable: Floats | None, frame: PipelineFrame) -> float:
    """How far the trunk is from where it was when motion was enabled; 0 where either is not known."""
    place = trunk_place(frame)
    if at_enable is None or place is None:
        return 0.0
    away = float(np.linalg.norm(place - at_enable))
    return away if isfinite(away) else 0.0


def trunk_place(frame: PipelineFrame) -> Floats | None:
    """Where the trunk is, (3,) m in the room: SpineShoulder of the fused body; None where it is not known."""
    if frame.fused is None:
        return None
    place: Floats = frame.fused.positions_in_room[INDEX["SpineShoulder"]]
    return place
