"""Ours: a ROS 2 robot behind rosbridge, emulated: how late it follows, how it stops, and what a tick pays for it."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.outcome import Beside, Outcome, Table, columns
from server.exoskeleton import BUILT_IN, device_limits
from server.experiments.rig.emulated_process import EmulatedProcess
from server.experiments.rig.measures import Percentiles, percentiles
from server.station.exo.driver import WATCHDOG_S, ZERO, DriveCommand, DriveMode, Joints
from server.station.exo.rosbridge.drive import STALE_S, RosbridgeDrive

PERIOD_S: Final = 0.01
LOOK_S: Final = 0.002
LEFT: Final = 0.1
"""With so much of the greatest speed left it counts as standing: the rest is the servos' own settling."""
WAVE_RAD: Final = 0.3
WAVE_RAD_S: Final = 3.0
MOVING_RAD_S: Final = 0.2
FASTEST_S: Final = 0.8
"""Before it is left alone the robot is moved for at most so long."""
TICK_MS: Final = 1.0
STALL_S: Final = 1.0
FOLLOWING: Final = "a command, processor time in the loop"
STALLED: Final = "a command, waiting included, while the peer stands still"
FELT_S: Final = 0.19


@dataclass(frozen=True, slots=True)
class Bench:
    """The two ends."""

    robot: EmulatedProcess
    drive: RosbridgeDrive

    def follow(
        self,
        path: Callable[[float], tuple[Joints, Joints]],
        seconds: float,
        clock: Callable[[], float] = time.thread_time,
    ) -> tuple[list[float], list[float]]:
        """Command a path at 100 Hz; how long each command took by `clock`, and by how much the elbow was late."""
        spent_s, behind_s, begun_s = [], [], time.monotonic()
        while (t_s := time.monotonic() - begun_s) < seconds:
            angles, speeds = path(t_s)
            measured = self.drive.read(begun_s + t_s)
            if abs(speeds[3]) > 0.7 * WAVE_RAD * WAVE_RAD_S and t_s > 1.0:
                behind_s.append((angles[3] - measured.angle_rad[3]) / speeds[3])
            called_s = clock()
            self.drive.command(DriveCommand(DriveMode.FOLLOW, angles, speeds, ""), begun_s + t_s)
            spent_s.append(clock() - called_s)
            time.sleep(max(begun_s + t_s + PERIOD_S - time.monotonic(), 0.0))
        return spent_s, behind_s

    def stand(self, seconds: float) -> list[float]:
        """Hold where it is; how long each command took, waiting included."""
        here = self.drive.read(time.monotonic()).angle_rad
        return self.follow(lambda _: (here, ZERO), seconds, time.perf_counter)[0]


def run(setup: Setup) -> Outcome:
    """Follow, stop, and fail, with the real drive over a real WebSocket on loopback."""
    with EmulatedProcess(BUILT_IN) as robot, RosbridgeDrive(robot.device) as drive:
        bench = Bench(robot, drive)
        spent_s, behind_s = _followed(bench, setup.long(30.0, 3.0))
        setup.progress(0.3)
        tries = (_left_alone(bench, np.random.default_rng((setup.seed, i))) for i in range(setup.many(40, 3)))
        stops = [late_s for late_s in tries if late_s is not None]
        setup.progress(0.8)
        faults = {typed: _noticed(bench, typed, setup.many(10, 1)) for typed in ("silent", "frozen", "drop")}
        stalled_s = _stalled(bench)
    times = {FOLLOWING: percentiles(spent_s), STALLED: percentiles(stalled_s)}
    return Outcome(
        _beside(times, percentiles(behind_s), stops, faults), (_table(times, stops, faults),), (), _WHY, (setup.seed,)
    )


def _followed(bench: Bench, seconds: float) -> tuple[list[float], list[float]]:
    here = bench.drive.read(time.monotonic()).angle_rad

    def wave(t_s: float) -> tuple[Joints, Joints]:
        up, speed = WAVE_RAD * (1 - math.cos(WAVE_RAD_S * t_s)), WAVE_RAD * WAVE_RAD_S * math.sin(WAVE_RAD_S * t_s)
        return tuple(angle + up for angle in here), (speed,) * 4

    found = bench.follow(wave, 2 * math.pi / WAVE_RAD_S * max(round(seconds * WAVE_RAD_S / (2 * math.pi)), 1))
    bench.stand(0.5)
    return found


def _left_alone(bench: Bench, random: np.random.Generator) -> float | None:
    """Move every angle at a speed of its own, cease without a word, and see how long after its ramp it stands, s.

    None where the machine kept this program from moving it.
    """
    limits = device_limits(BUILT_IN)
    here = np.array(bench.drive.read(time.monotonic()).angle_rad)
    middle = np.array([(joint.min_rad + joint.max_rad) / 2 for joint in limits])
    fastest = np.array([joint.velocity_rad_s for joint in limits])
    speeds = np.sign(middle - here) * random.uniform(0.2, 0.5, 4) * fastest
    ramp = np.array([joint.acceleration_rad_s2 for joint in limits]) / 2

    def away(t_s: float) -> tuple[Joints, Joints]:
        rising = np.abs(speeds) / ramp
        t = np.minimum(t_s, rising)
        angles = here + np.sign(speeds) * ramp * t * t / 2 + speeds * (t_s - t)
        return tuple(angles.tolist()), tuple((np.sign(speeds) * ramp * t).tolist())

    bench.follow(away, float(random.uniform(0.4, FASTEST_S)))
    begun_s = moved_s = time.monotonic()
    began = np.abs(bench.drive.read(begun_s).velocity_rad_s)
    if began.max() < MOVING_RAD_S:
        bench.stand(0.3)
        return None
    while (now_s := time.monotonic()) - begun_s < 1.0:
        seen = bench.drive.read(now_s)
        if np.abs(seen.velocity_rad_s).max() > LEFT * began.max():
            moved_s = max(moved_s, seen.t_s)  # when it was measured, however late that came
        time.sleep(LOOK_S)
    bench.stand(0.3)
    braking = np.array([joint.acceleration_rad_s2 for joint in limits])
    return moved_s - begun_s - float(np.max(began / braking))


def _noticed(bench: Bench, typed: str, times: int) -> list[float]:
    """How long after it failed the drive says so, s, looking every 2 ms."""
    found = []
    for _ in range(times):
        bench.stand(0.5)
        bench.robot.tell(typed)
        begun_s = time.monotonic()
        while not bench.drive.read(time.monotonic()).fault and time.monotonic() - begun_s < 5.0:
            time.sleep(LOOK_S)
        found.append(time.monotonic() - begun_s)
        bench.robot.tell("well")
        while bench.drive.read(time.monotonic()).fault and time.monotonic() - begun_s < 10.0:
            time.sleep(PERIOD_S)
    return found


def _stalled(bench: Bench) -> list[float]:
    bench.stand(0.3)
    bench.robot.tell(f"stall {STALL_S}")
    return bench.stand(0.9 * STALL_S)


def _beside(
    times: dict[str, Percentiles], behind: Percentiles, stops: list[float], faults: dict[str, list[float]]
) -> tuple[Beside, ...]:
    noticed_s, late_s = max(max(found) for found in faults.values()), max(stops)
    allowed_s = STALE_S + 2 * PERIOD_S
    return (
        Beside(
            "from command to measured movement, median",
            f"a small part of {1e3 * FELT_S:g} ms",
            f"{behind.p50_ms:.1f} ms",
            behind.p50_ms < 1e3 * FELT_S / 4,
        ),
        Beside(
            f"a robot that hears nothing more stands, beyond its ramp, median and slowest of {len(stops)} (SR-3)",
            f"within {1e3 * WATCHDOG_S:g} ms",
            f"{1e3 * float(np.median(stops)):.0f}, {1e3 * late_s:.0f} ms",
            late_s <= WATCHDOG_S,
        ),
        Beside(
            "silence, repetition or a broken link is a fault, median and slowest (SR-8)",
            f"within {1e3 * allowed_s:g} ms",
            f"{1e3 * float(np.median(np.concatenate(list(faults.values())))):.0f}, {1e3 * noticed_s:.0f} ms",
            noticed_s <= allowed_s,
        ),
        Beside(
            f"{FOLLOWING}, p50 / p99 / max",
            f"p99 below {TICK_MS:g} ms",
            times[FOLLOWING].words,
            times[FOLLOWING].p99_ms < TICK_MS,
        ),
        Beside(
            f"{STALLED}, p50 / p99 / max",
            f"none of {STALL_S:g} s",
            times[STALLED].words,
            times[STALLED].max_ms < 1e3 * STALL_S / 10,
        ),
    )


def _table(times: dict[str, Percentiles], stops: list[float], faults: dict[str, list[float]]) -> Table:
    measured = dict(times)
    measured |= {"stands after the last command, beyond its ramp": percentiles(stops)}
    measured |= {f"fault after '{typed}'": percentiles(found) for typed, found in faults.items()}
    rows = tuple((what, each.count, each.p50_ms, each.p99_ms, each.max_ms) for what, each in measured.items())
    headings = columns("what", "times", "p50 [ms]", "p99 [ms]", "max [ms]", digits=2)
    return Table("rosbridge", "A robot behind rosbridge", headings, rows)


_WHY = (
    "The robot is emulated and on this machine: a real rosbridge, DDS and controller add their delay. What is shown "
    "is that the drive itself costs little, that a robot which hears nothing more stops by what it was told last, and "
    "that nothing which the other side does holds up a tick."
)
EXPERIMENT = Experiment(
    "rosbridge",
    Chapter.SAFETY,
    "A ROS 2 robot behind rosbridge: following, stopping, failing",
    "No paper says. SR-3 gives a drive 100 ms to begin to stop when no command comes, and its ramp; SR-8 wants every "
    "single fault noticed in its time.",
    "The real drive and an emulated rosbridge server over a real WebSocket: a wave of 0.9 rad/s, then movements at "
    "random speeds that cease without a word, then a robot that goes silent, repeats itself, or is cut off.",
    run,
    order=60,
    only_by_name=True,
)
