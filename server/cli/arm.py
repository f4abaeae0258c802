"""`mirrorlimb arm`: shoulder, elbow, wrist and hand from inertial sensors alone."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Annotated, Final

import numpy as np
import typer
from rich.console import Console
from rich.progress import Progress

from fusion.errors import InputError
from fusion.inertial.arm import SEGMENTS, ArmSensors, InertialArm, sides_worn, track_arm
from fusion.inertial.chain import CHAIN_JOINTS
from fusion.inertial.lengths import USUAL, lengths_seen
from fusion.inertial.long_axes import from_movement, from_pose
from fusion.inertial.orientation import Inertial, Oriented, orient, together
from fusion.inertial.pose import checked_pose, find_pose
from fusion.inertial.stills import Return, compared
from fusion.messages import ArmLengths
from fusion.recording.reader import Recording, read_recording
from fusion.skeleton import Side

FILE: Final = "arm.csv"
COLUMNS: Final = "t_s,side,joint,x_m,y_m,z_m"
LONGEST_M: Final = 1.0

Length = Annotated[float | None, typer.Option(metavar="M", help="Metres; else as the recording's camera saw it.")]


def arm(
    recording: Annotated[Path, typer.Argument(help="A recording: its folder or a .mcap file.", show_default=False)],
    out: Annotated[Path, typer.Option(metavar="FOLDER", help=f"Where {FILE} goes.")],
    pose: Annotated[
        tuple[float, float] | None,
        typer.Option(metavar="FROM TO", help="When the arms hung still; else looked for in the first 10 s."),
    ] = None,
    by_movement: Annotated[
        bool, typer.Option("--by-movement", help="Calibrate from how the arm moves instead; the trunk must keep still.")
    ] = False,
    upper_arm: Length = None,
    forearm: Length = None,
    hand: Length = None,
    compare: Annotated[
        tuple[float, float, float, float] | None,
        typer.Option(metavar="FROM TO FROM TO", help="Say whether the elbow came back between two still intervals."),
    ] = None,
) -> None:
    """Follow the arms by the inertial sensors on upper arm, forearm and hand; no magnetometer, no camera."""
    console = Console(stderr=True)
    source = read_recording(recording)
    given = (upper_arm, forearm, hand)
    _check_lengths(given)
    if by_movement and pose is not None:
        raise InputError("--pose and --by-movement exclude each other", "one of them", "leave one out")
    sides = sides_worn([stream.site for stream in source.imu_streams])
    arms = []
    with Progress(console=console, transient=True) as progress:
        for side in progress.track(sides, description=source.name):
            arms.append(_tracked(source, side, given, pose, by_movement))
    _write([found for _, found in arms], out)
    for sensors, found in arms:
        console.print(_summary(found), highlight=False, markup=False, soft_wrap=True)
        if compare is not None:
            came_back = compared(sensors, found, compare[:2], compare[2:])
            console.print(_came_back(came_back), highlight=False, markup=False, soft_wrap=True)


def _tracked(
    source: Recording,
    side: Side,
    given: Sequence[float | None],
    pose: tuple[float, float] | None,
    by_movement: bool,
) -> tuple[ArmSensors, InertialArm]:
    worn = _oriented(source, side)
    if by_movement:
        axes = from_movement(*worn)
    else:
        axes = from_pose(*worn, find_pose(worn) if pose is None else checked_pose(worn, *pose))
    sensors = ArmSensors(*worn)
    return sensors, track_arm(side, sensors, _lengths(source, side, given), axes)


def _oriented(source: Recording, side: Side) -> tuple[Oriented, Oriented, Oriented]:
    by_site = {stream.site: stream for stream in source.imu_streams}
    worn = [by_site[f"{segment}-{side.value}"] for segment in SEGMENTS]
    upper, forearm, hand = together([Inertial(s.site, s.t_s, s.gyro_rad_s, s.accel_m_s2) for s in worn])
    return orient(upper), orient(forearm), orient(hand)


def _check_lengths(given: Sequence[float | None]) -> None:
    for length_m in given:
        if length_m is not None and not 0 < length_m <= LONGEST_M:
            raise InputError(f"a segment of {length_m:g} m", f"between 0 and {LONGEST_M:g} m", "give metres")


def _lengths(source: Recording, side: Side, given: Sequence[float | None]) -> ArmLengths:
    primary = [sample for stream in source.skeleton_streams if stream.primary for sample in stream.samples]
    known = lengths_seen(primary, side) or USUAL
    measured = (known.upper_arm_m, known.forearm_m, known.hand_m)
    return ArmLengths(*(known_m if m is None else m for m, known_m in zip(given, measured, strict=True)))


def _write(arms: Sequence[InertialArm], folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / FILE).write_text("".join(_lines(arms)), encoding="utf-8")
    except OSError as error:
        what = f"{folder} cannot be written: {error.strerror}"
        raise InputError(what, "a folder of yours", "choose another --out") from error


def _lines(arms: Sequence[InertialArm]) -> Iterator[str]:
    """A line per arm, instant and joint; picometres, so that the segments' lengths can be seen to be constant."""
    yield f"{COLUMNS}\n"
    for found in arms:
        for t_s, points in zip(found.t_s.tolist(), found.positions.tolist(), strict=True):
            for joint, (x, y, z) in zip(CHAIN_JOINTS, points, strict=True):
                yield f"{t_s:.6f},{found.side.value},{joint},{x:.12f},{y:.12f},{z:.12f}\n"


def _summary(found: InertialArm) -> str:
    bent = np.degrees(found.angles.elbow_flexion_rad)
    pose = found.long_axes.pose
    hung = "calibrated from movement" if pose is None else f"hung from {pose.from_s:.1f} to {pose.to_s:.1f} s"
    bend = f"bent by {np.degrees(found.hanging_flexion_rad):.0f}°"
    off = f"off the hinge {np.degrees(found.off_hinge_rad):.0f}° rms"
    begun = hung if pose is None else f"{hung}, {bend}"
    return f"{found.side.value}: {begun}; elbow {bent.min():.0f} to {bent.max():.0f}°, {off}"


def _came_back(found: Return) -> str:
    upper, fore, before, after = np.degrees([found.nearest_upper_rad, found.nearest_forearm_rad, *found.elbow_rad])
    share = f"gravity agrees within 5° in {found.agreeing} of {found.pairs} pairs"
    elbow = f"  elbow {before:.0f}° and {after:.0f}° (medians); {share}"
    if found.agreeing:
        return f"{elbow}, the elbow there within {np.degrees(found.largest_apart_rad):.1f}°"
    return f"{elbow}; in the nearest pair it turned by {upper:.0f}° (upper arm) and {fore:.0f}° (forearm): another pose"
