"""`python tests/server/emulated/cia402/measure.py [SECONDS]`: seven emulated drives in a process of their own, the
station's drive in this one at 100 Hz; prints what a tick costs, how late the motion is, and how soon a killed station's
drives stand. Nothing else may need the machine meanwhile.
"""

from __future__ import annotations

import os
import signal
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from drive_process import LED, RESTING, Drives, drives_in, moving_station

from server.exoskeleton_file import read_exoskeleton
from server.station.exo.cia402 import Cia402Drive
from server.station.exo.driver import ZERO, DriveCommand, DriveMode

HEARTBEAT_S = 0.05
PATIENT_S = 0.25
"""Heartbeat while ticks are measured: other work on the machine should lengthen the figures, not end the run."""
REPEATS = 5
WARM_TICKS = 200


def main() -> None:
    """Measure and print."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 10.0
    with tempfile.TemporaryDirectory() as folder, drives_in(Path(folder), PATIENT_S, RESTING) as drives:
        _ticks(drives, seconds)
    stood = []
    for _ in range(REPEATS):
        with tempfile.TemporaryDirectory() as folder, drives_in(Path(folder), HEARTBEAT_S, RESTING) as drives:
            stood += _killed(drives)
    sys.stdout.write(f"{len(stood)} of {REPEATS} stations were killed while they moved the arm:\n")
    begun, rest = zip(*stood, strict=True)
    _say("kill -9 to the drives' own quick stop", begun)
    _say("kill -9 to every joint at rest", rest)


def _ticks(drives: Drives, seconds: float) -> None:
    opened_s = time.monotonic()
    with Cia402Drive(read_exoskeleton(drives.file)) as drive:
        sys.stdout.write(f"start, checks and limits of 7 drives: {time.monotonic() - opened_s:.2f} s\n")
        start, told, seen, costs = drive.read(time.monotonic()).angle_rad, [], [], []
        next_s = begun_s = time.monotonic()
        while next_s - begun_s < seconds + WARM_TICKS / 100:
            now_s, worked_s = time.monotonic(), time.perf_counter()
            reading = drive.read(now_s)
            moving_s = max(now_s - begun_s - WARM_TICKS / 100, 0.0)
            wanted = tuple(angle + 0.2 * (1 - np.cos(3 * moving_s)) for angle in start)
            mode = DriveMode.FOLLOW if moving_s else DriveMode.HOLD
            drive.command(DriveCommand(mode, wanted, ZERO, ""), now_s)
            costs.append(time.perf_counter() - worked_s)
            told.append((now_s, wanted[3]))
            seen.append((now_s, reading.angle_rad[3]))
            if reading.fault:
                sys.stdout.write(f"{reading.fault}\n")
                return
            next_s += 0.01
            time.sleep(max(next_s - time.monotonic(), 0.0))
    _say("a tick's read and command", costs[WARM_TICKS:])
    moved = slice(WARM_TICKS, None)
    true = [(line.t_s, line.angle_rad) for line in drives.lines("elbow") if line.t_s > told[WARM_TICKS][0]]
    _lag("command to true motion", told[moved], true)
    _lag("command to measured motion", told[moved], seen[moved])


def _lag(what: str, told: list[tuple[float, float]], moved: list[tuple[float, float]]) -> None:
    """The delay at which the command explains the motion best."""
    (t_told, wanted), (t_moved, angle) = np.array(told).T, np.array(moved).T
    inside = (t_moved > t_told[0] + 0.1) & (t_moved < t_told[-1])
    delays = np.arange(0.0, 0.08, 0.0005)
    off = [np.sqrt(np.mean((np.interp(t_moved[inside] - d, t_told, wanted) - angle[inside]) ** 2)) for d in delays]
    best = int(np.argmin(off))
    sys.stdout.write(f"{what}: {1000 * delays[best]:.1f} ms (rms about it {np.degrees(off[best]):.3f} degrees)\n")


def _killed(drives: Drives) -> list[tuple[float, float]]:
    """Times to quick stop and to rest; none where the machine was so busy that the drives had stopped before."""
    with moving_station(drives) as station:
        time.sleep(2.0)
        killed_s = time.monotonic()
        os.kill(station.pid, signal.SIGKILL)
        time.sleep(1.0)
    after = [line for name, *_ in LED for line in drives.lines(name) if line.t_s > killed_s]
    following = [line.t_s for line in after if line.state == "operation enabled"]
    if not following:
        return []
    moving = max((line.t_s for line in after if abs(line.velocity_rad_s) > 0.01), default=killed_s)
    return [(max(following) - killed_s, moving - killed_s)]


def _say(what: str, times_s: object) -> None:
    p50, p99, most = np.percentile(np.array(times_s) * 1000, (50, 99, 100))
    sys.stdout.write(f"{what}: p50 {p50:.2f} ms, p99 {p99:.2f} ms, greatest {most:.2f} ms\n")


if __name__ == "__main__":
    main()
