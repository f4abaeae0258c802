"""The three files that `mirrorlimb fuse` writes: fused.csv, angles.csv, report.json."""

from __future__ import annotations

import json
import os
import platform
from collections.abc import Iterator
from errno import EACCES
from pathlib import Path

import numpy as np
import scipy

from fusion.errors import InputError
from fusion.kinematics.angles import swing_from_direction, wrapped
from fusion.messages import JointAngles, MirrorTarget
from fusion.offline import FusedRecording, SensorReport
from fusion.recording.lines import lines_of
from fusion.skeleton import JOINTS, Side
from server import __version__

FORMAT = "mirrorlimb-fused/1"
JOINT_COLUMNS = ("t_s", "joint", "x_m", "y_m", "z_m", "bound_m", "state")
JOINT_PLACES = (4, 4, 4, 4, 4, 0)
ANGLE_COLUMNS = (
    "t_s",
    "side",
    "plane_of_elevation_rad",
    "elevation_rad",
    "axial_rotation_rad",
    "elbow_flexion_rad",
    "alpha_rad",
    "beta_rad",
    "gamma_rad",
    "valid",
    "swing_bound_rad",
    "twist_bound_rad",
    "elbow_bound_rad",
)
ANGLE_PLACES = (4, *[5] * 7, 0, *[5] * 3)
"""Decimal places of the columns that hold numbers."""


def make_folder(folder: Path) -> None:
    """Make the folder for the files; call it before the work, so that nothing is worked out in vain.

    Raises:
        InputError: it cannot be made or written to.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise _not_written(folder, error) from error
    if not os.access(folder, os.W_OK):
        raise _not_written(folder, PermissionError(EACCES, os.strerror(EACCES)))


def _not_written(folder: Path, error: OSError) -> InputError:
    return InputError(f"{folder} cannot be written: {error.strerror}", "a folder of yours", "choose another --out")


def write_fused(fused: FusedRecording, folder: Path) -> None:
    """Write the files, replacing older ones.

    Args:
        fused: what the pipeline said.
        folder: as `make_folder` left it.

    Raises:
        InputError: the files cannot be written.
    """
    try:
        (folder / "fused.csv").write_bytes(_head(JOINT_COLUMNS) + _joint_lines(fused))
        (folder / "angles.csv").write_bytes(_head(ANGLE_COLUMNS) + _angle_lines(fused))
        report = json.dumps(_report(fused), indent=1, allow_nan=False)
        (folder / "report.json").write_text(report + "\n", encoding="utf-8")
    except OSError as error:
        raise _not_written(folder, error) from error


def _head(columns: tuple[str, ...]) -> bytes:
    return f"{','.join(columns)}\n".encode()


def _joint_lines(fused: FusedRecording) -> bytes:
    """A line per instant and joint; joints never seen are left out."""
    seen = np.nonzero(np.isfinite(fused.positions).all(axis=(0, 2)))[0]
    instants, joints = len(fused.t_s), len(seen)
    numbers = np.empty((instants, joints, 6))
    numbers[..., 0] = fused.t_s[:, None]
    numbers[..., 1:4] = fused.positions[:, seen]
    numbers[..., 4] = fused.bound_m[:, seen]
    numbers[..., 5] = fused.state[:, seen]
    return lines_of(numbers.reshape(-1, 6), JOINT_PLACES, JOINTS, np.tile(seen, instants))


def _angle_lines(fused: FusedRecording) -> bytes:
    """The healthy arm and the mirrored target at every instant that has them."""
    rows = list(_angle_rows(fused))
    numbers = np.array([numbers for _, numbers in rows]).reshape(-1, len(ANGLE_PLACES))
    sides = [side.value for side in Side]
    return lines_of(numbers, ANGLE_PLACES, sides, np.array([sides.index(side) for side, _ in rows], dtype=np.int64))


def _angle_rows(fused: FusedRecording) -> Iterator[tuple[str, list[float]]]:
    for t_s, healthy, target in zip(fused.t_s.tolist(), fused.healthy, fused.target, strict=True):
        if healthy is not None:
            yield healthy.side.value, [t_s, *_healthy_values(healthy), *_worth(healthy)]
        if target is not None:
            yield target.side.value, [t_s, *_target_values(target), *_worth(target)]


def _worth(told: JointAngles | MirrorTarget) -> list[float]:
    """Whether the angles count, and their bounds."""
    return [told.valid, told.swing_bound_rad, told.twist_bound_rad, told.elbow_bound_rad]


def _healthy_values(healthy: JointAngles) -> list[float]:
    return [
        healthy.plane_of_elevation_rad,
        healthy.elevation_rad,
        healthy.axial_rotation_rad,
        healthy.elbow_flexion_rad,
        healthy.alpha_rad,
        healthy.beta_rad,
        healthy.gamma_rad,
    ]


def _target_values(target: MirrorTarget) -> list[float]:
    """The same seven angles of the arm as commanded; mirror images have equal angles, each in its own side's frame."""
    plane, elevation = swing_from_direction(target.direction_in_limb)
    outward, up, _ = (float(part) for part in target.direction_in_limb)
    beta = float(np.arctan2(up, -outward))
    axial = wrapped(target.twist_rad - plane)
    return [plane, elevation, axial, target.elbow_rad, np.pi - elevation, beta, target.elbow_rad]


def _report(fused: FusedRecording) -> dict[str, object]:
    timings = fused.timings
    return {
        "format": FORMAT,
        "recording": fused.name,
        "method": fused.method,
        "causal": fused.causal,
        "reference": fused.reference,
        "healthy_side": fused.healthy_side.value,
        "instants": len(fused.t_s),
        "sensors": {sensor.sensor: _sensor(sensor) for sensor in fused.sensors},
        "other_sensors": {"used": list(fused.others.used), "unusable": dict(fused.others.unusable)},
        "timings": {
            "recording_s": timings.recording_s,
            "align_s": timings.align_s,
            "fuse_s": timings.fuse_s,
            "times_real_time": timings.times_real_time,
        },
        "versions": {
            "mirrorlimb": __version__,
            "python": platform.python_version(),
            "numpy": np.__version__,
            "scipy": scipy.__version__,
        },
    }


def _sensor(sensor: SensorReport) -> dict[str, object]:
    """One sensor's entry; alignment fields are null where it could not be aligned."""
    found = sensor.alignment
    return {
        "is_reference": sensor.is_reference,
        "aligned": found is not None,
        "rotation_sensor_to_reference": found.rotation_sensor_to_reference.tolist() if found else None,
        "translation_m": found.translation_m.tolist() if found else None,
        "clock_offset_s": found.clock_offset_s if found else None,
        "residual_m": found.residual_m if found else None,
        "rotation_std_deg": float(np.degrees(found.rotation_std_rad)) if found else None,
        "position_std_mm": found.position_std_m * 1e3 if found else None,
        "frames": sensor.frames,
        "frames_aligned_on": found.frames if found else 0,
        "refusals": sensor.refusals,
        "warnings": list(sensor.warnings),
    }
