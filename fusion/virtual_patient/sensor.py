"""A depth camera that sees the virtual patient as badly as a real one."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin, sqrt
from typing import Final

import numpy as np
from scipy.spatial.transform import Rotation

from fusion.messages import Floats, SkeletonSample, States
from fusion.skeleton import INDEX, JOINT_COUNT, JOINTS, TrackingState


@dataclass(frozen=True, slots=True)
class NoiseLevel:
    """How wrong a sensor's joints are, along its own axes (m)."""

    mean_m: tuple[float, float, float]
    """Systematic error."""
    std_m: tuple[float, float, float]
    correlation: float
    """From one frame to the next."""
    drift_m: float
    """Standard deviation of a bias that each joint has for itself and that changes within about 20 s."""
    interval_m: tuple[float, float, float]
    """No error is larger than this, mean apart."""


NO_NOISE: Final = NoiseLevel((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 0.0, 0.0, (0.0, 0.0, 0.0))
DEMO: Final = NoiseLevel((0.0, 0.0, 0.0), (0.012, 0.012, 0.012), 0.7, 0.006, (0.06, 0.06, 0.06))
"""A good sensor in a quiet room, so that the picture does not shake."""
TABLE1: Final = NoiseLevel((-0.0154, -0.0361, 0.0160), (0.0456, 0.0387, 0.0541), 0.9, 0.0, (0.2, 0.15, 0.2))
"""[Du2016, Table 1]: one Kinect against Vicon."""

TABLE1_CENTRED: Final = NoiseLevel((0.0, 0.0, 0.0), TABLE1.std_m, TABLE1.correlation, 0.0, TABLE1.interval_m)
"""The same with the means taken off, as the paper does before it fuses."""


@dataclass(frozen=True, slots=True)
class SensorPose:
    """Where a sensor stands in the world and how it looks."""

    position_in_world: Floats  # (3,) m
    rotation_sensor_to_world: Floats  # (3, 3)

    @staticmethod
    def around(
        azimuth_rad: float, distance_m: float = 2.0, height_m: float = 1.0, tilt_rad: float = 0.05
    ) -> SensorPose:
        """A sensor that looks at the patient.

        Args:
            azimuth_rad: 0 = straight ahead of the patient, π/2 = at the patient's right.
            distance_m: from the patient's place.
            height_m: above the floor.
            tilt_rad: looking down.
        """
        position = np.array([distance_m * sin(azimuth_rad), height_m, -distance_m * cos(azimuth_rad)])
        # Turning about the vertical by −azimuth keeps the lens on the patient; a turn about x by the tilt lowers it.
        turn = Rotation.from_euler("YX", [-azimuth_rad, tilt_rad])
        return SensorPose(position, np.asarray(turn.as_matrix()))

    def to_sensor(self, positions_in_world: Floats) -> Floats:
        """(..., 3) m in the sensor's frame."""
        in_sensor: Floats = (positions_in_world - self.position_in_world) @ self.rotation_sensor_to_world
        return in_sensor


_PERIOD_S: Final = 1 / 30
_DRIFT_S: Final = 20.0
_INFERRED_NOISE: Final = 3.0
"""An inferred joint is this much worse than a tracked one."""
_LOST_SHARE: Final = 0.25
"""Share of hidden joints that are lost rather than inferred."""
_TORSO_RADIUS_M: Final = 0.11
_BEHIND_M: Final = 0.08
"""A joint is hidden if the torso stands at least this far before it."""
_FINE: Final = np.array([INDEX[name] for name in JOINTS if name.startswith(("HandTip", "Thumb"))])
_CAN_HIDE: Final = np.array([name.endswith(("Left", "Right")) for name in JOINTS])


class VirtualSensor:
    """A sensor with its own frame, clock, noise and blind spots.

    Args:
        name: of the sensor.
        pose: where it stands.
        seed: of everything random.
        noise: how bad it is.
        clock_offset_s: its clock minus the true time (t_true = t_sensor − offset).
        dropped_share: share of frames that never leave it.
        body: its number for the patient.
    """

    def __init__(
        self,
        name: str,
        pose: SensorPose,
        seed: int,
        *,
        noise: NoiseLevel = DEMO,
        clock_offset_s: float = 0.0,
        dropped_share: float = 0.01,
        body: str = "1",
    ) -> None:
        self.name, self.pose, self.clock_offset_s = name, pose, clock_offset_s
        self._noise, self._dropped_share, self._body = noise, dropped_share, body
        self._rng = np.random.default_rng(seed)
        self._error = self._rng.standard_normal((JOINT_COUNT, 3))
        self._drift = self._rng.standard_normal((JOINT_COUNT, 3))
        self._lost = np.zeros(JOINT_COUNT, dtype=bool)
        self._hidden = np.zeros(JOINT_COUNT, dtype=bool)
        self._due_s = float(self._rng.uniform(0.0, _PERIOD_S))

    def see(self, positions_in_world: Floats, t_s: float) -> SkeletonSample | None:
        """The frame that is due at the true time `t_s`, if one is; call it at least as often as 30 times a second.

        Args:
            positions_in_world: (25, 3) m, where the joints are now.
            t_s: true time; `t_received_s` of the sample.

        Returns:
            The sample in the sensor's frame and clock; None between frames and for a dropped one.
        """
        if t_s < self._due_s:
            return None
        self._due_s = max(self._due_s + _PERIOD_S, t_s)
        state = self._states(positions_in_world)
        positions = self.pose.to_sensor(positions_in_world) + self._errors(state)
        positions[state == TrackingState.LOST] = np.nan
        if self._rng.uniform() < self._dropped_share:
            return None
        return SkeletonSample(self.name, self._body, t_s + self.clock_offset_s, t_s, positions, state)

    def _errors(self, state: States) -> Floats:  # (25, 3)
        """Correlated noise of unit size, stepped by a frame, brought to size and kept inside the interval."""
        keep, drift_keep = self._noise.correlation, 1.0 - _PERIOD_S / _DRIFT_S
        fresh = self._rng.standard_normal((2, JOINT_COUNT, 3))
        self._error = keep * self._error + sqrt(1 - keep**2) * fresh[0]
        self._drift = drift_keep * self._drift + sqrt(1 - drift_keep**2) * fresh[1]
        worse = np.where(state == TrackingState.INFERRED, _INFERRED_NOISE, 1.0)[:, None]
        error = worse * np.array(self._noise.std_m) * self._error + self._noise.drift_m * self._drift
        interval = np.array(self._noise.interval_m)
        bounded: Floats = np.clip(error, -interval, interval) + np.array(self._noise.mean_m)
        return bounded

    def _states(self, positions_in_world: Floats) -> States:
        hidden = hidden_by_torso(positions_in_world, self.pose.position_in_world)
        newly = hidden & ~self._hidden
        self._lost = np.where(newly, self._rng.uniform(size=JOINT_COUNT) < _LOST_SHARE, self._lost)
        self._hidden = hidden
        states = np.where(hidden, TrackingState.INFERRED, TrackingState.TRACKED)
        states[hidden & self._lost] = TrackingState.LOST
        states[_FINE[hidden[_FINE]]] = TrackingState.LOST
        return states.astype(np.uint8)


def hidden_by_torso(positions: Floats, lens: Floats) -> np.ndarray:  # (25,) bool
    """Which limb joints the torso hides: the line of sight passes the spine within its radius, well before the joint.

    Closest points of the two segments lens–joint and pelvis–neck, found by clamping one parameter after the other.

    Args:
        positions: (25, 3) m in any frame.
        lens: (3,) m in the same frame.
    """
    base, top = positions[INDEX["SpineBase"]], positions[INDEX["Neck"]]
    spine, sight, start = top - base, positions - lens, lens - base
    a, e = (sight**2).sum(axis=1), float(spine @ spine)
    b, c, f = sight @ spine, sight @ start, float(spine @ start)
    slant = np.maximum(a * e - b * b, 1e-12)
    along_spine = np.clip((b * np.clip((b * f - c * e) / slant, 0.0, 1.0) + f) / e, 0.0, 1.0)
    along_sight = np.clip((b * along_spine - c) / a, 0.0, 1.0)
    gap = start + along_sight[:, None] * sight - along_spine[:, None] * spine
    close = np.linalg.norm(gap, axis=1) < _TORSO_RADIUS_M
    behind = (1.0 - along_sight) * np.sqrt(a) > _BEHIND_M
    hidden: np.ndarray = close & behind & _CAN_HIDE
    return hidden
