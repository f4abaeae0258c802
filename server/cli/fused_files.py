"""The three files that `mirrorlimb fuse` writes: fused.csv, angles.csv, report.json."""

from __future__ import annotations

import csv
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
from fusion.skeleton import JOINTS
from server import __version__

FORMAT = "mirrorlimb-fused/1"
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
        (folder / "fused.csv").write_text("".join(_joint_lines(fused)), encoding="utf-8")
        with (folder / "angles.csv").open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(ANGLE_COLUMNS)
            writer.writerows(_angle_rows(fused))
        report = json.dumps(_report(fused), indent=1, allow_nan=False)
        (folder / "report.json").write_text(report + "\n", encoding="utf-8")
    except OSError as error:
        raise _not_written(folder, error) from error


def _joint_lines(fused: FusedRecording) -> Iterator[str]:
    """A line per instant and joint; joints never seen are left out."""
    yield "t_s,joint,x_m,y_m,z_m,bound_m,state\n"
    seen = np.nonzero(np.isfinite(fused.positions).all(axis=(0, 2)))[0].tolist()
    rows = zip(fused.t_s.tolist(), fused.positions.tolist(), fused.bound_m.tolist(), fused.state.tolist(), strict=True)
    for t_s, positions, bound_m, state in rows:
        for j in seen:
            x, y, z = positions[j]
            yield f"{t_s:.4f},{JOINTS[j]},{x:.4f},{y:.4f},{z:.4f},{bound_m[j]:.4f},{state[j]}\n"


def _angle_rows(fused: FusedRecording) -> Iterator[list[str]]:
    """The healthy arm and the mirrored target at every instant that has them."""
    for t_s, healthy, target in zip(fused.t_s.tolist(), fused.healthy, fused.target, strict=True):
        if healthy is not None:
            yield _row(t_s, healthy.side.value, _healthy_values(healthy), healthy)
        if target is not None:
            yield _row(t_s, target.side.value, _target_values(target), target)


def _row(t_s: float, side: str, angles: list[float], told: JointAngles | MirrorTarget) -> list[str]:
    bounds = [told.swing_bound_rad, told.twist_bound_rad, told.elbow_bound_rad]
    return [f"{t_s:.4f}", side, *map(_number, angles), str(int(told.valid)), *map(_number, bounds)]


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


def _number(value: float) -> str:
    return f"{value:.5f}"


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
