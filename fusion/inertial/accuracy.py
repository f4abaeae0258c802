"""How near the inertial arm comes to the truth, beside the paper's figures [Liu2017 §4].

`python -m fusion.inertial.accuracy` prints the table of docs/inertial.md.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.spatial.transform import Rotation

from fusion.geometry import Floats
from fusion.inertial.arm import ArmSensors, InertialArm, track_arm
from fusion.inertial.chain import CHAIN_JOINTS
from fusion.inertial.long_axes import from_movement, from_pose
from fusion.inertial.orientation import orient
from fusion.inertial.pose import find_pose
from fusion.inertial.simulation import SensorErrors, SimulatedArm, simulate_arm
from fusion.skeleton import Side

PAPER_CORRELATION: Final = {"shoulder": 0.91, "elbow": 0.79, "wrist": 0.70, "hand": None}
SEEDS: Final = range(8)
WORN: Final = SensorErrors(skin_rad=np.radians(3.0), pose_rad=np.radians(5.0))
"""The same sensors on skin and after a pose that was not quite right."""


@dataclass(frozen=True, slots=True)
class JointAccuracy:
    """One joint's error against the truth, over all runs."""

    joint: str
    rms_m: float
    turned_rms_m: float
    """After one constant turn about up per run (the paper fits scale, rotation and translation)."""
    p95_m: float
    max_m: float
    correlation: float
    """Mean over runs and axes of Pearson's coefficient, as found: nothing is fitted to the truth first."""


def track_simulated(truth: SimulatedArm, by_movement: bool = False) -> InertialArm:
    """The inertial arm of a simulated one, calibrated from the pose at its beginning or from its movement."""
    upper, forearm, hand = (orient(sensor) for sensor in truth.sensors)
    if by_movement:
        axes = from_movement(upper, forearm, hand)
    else:
        axes = from_pose(upper, forearm, hand, find_pose((upper, forearm, hand)))
    return track_arm(Side.RIGHT, ArmSensors(upper, forearm, hand), truth.lengths, axes)


def joint_accuracy(truths: Iterable[SimulatedArm], by_movement: bool = False) -> tuple[JointAccuracy, ...]:
    """Errors of elbow, wrist and hand; the shoulder is the origin of both and has none."""
    pairs = [(truth.positions, track_simulated(truth, by_movement).positions) for truth in truths]
    return tuple(_joint(number, pairs) for number in range(1, len(CHAIN_JOINTS)))


def table(joints: Iterable[JointAccuracy]) -> str:
    """The figures as Markdown, the paper's beside them."""
    lines = [
        "| joint | rms mm | after one turn mm | p95 mm | max mm | correlation | [Liu2017] |",
        "|---|---|---|---|---|---|---|",
        f"| shoulder | 0 | 0 | 0 | 0 | the origin | {PAPER_CORRELATION['shoulder']:.2f} |",
    ]
    for found in joints:
        paper = PAPER_CORRELATION[found.joint]
        millimetres = " | ".join(
            f"{value * 1e3:.0f}" for value in (found.rms_m, found.turned_rms_m, found.p95_m, found.max_m)
        )
        beside = "not given" if paper is None else f"{paper:.2f}"
        lines.append(f"| {found.joint} | {millimetres} | {found.correlation:.3f} | {beside} |")
    return "\n".join(lines)


def _joint(number: int, pairs: list[tuple[Floats, Floats]]) -> JointAccuracy:
    errors = np.concatenate([np.linalg.norm(found[:, number] - truth[:, number], axis=1) for truth, found in pairs])
    correlations = [_correlation(truth[:, number], found[:, number]) for truth, found in pairs]
    p95, largest = np.percentile(errors, [95, 100])
    rms = float(np.sqrt(np.mean(errors**2)))
    turned = [_turned(truth, found)[:, number] - truth[:, number] for truth, found in pairs]
    turned_rms = float(np.sqrt(np.mean(np.sum(np.concatenate(turned) ** 2, axis=1))))
    return JointAccuracy(
        CHAIN_JOINTS[number], rms, turned_rms, float(p95), float(largest), float(np.mean(correlations))
    )


def _turned(truth: Floats, found: Floats) -> Floats:
    """The found positions (T, 4, 3) after the constant turn about up that brings them nearest to the truth."""
    level, level_truth = found[..., 2] + 1j * found[..., 0], truth[..., 2] + 1j * truth[..., 0]
    angle_rad = float(np.angle(np.sum(level_truth * level.conj())))
    turned: Floats = Rotation.from_rotvec([0.0, angle_rad, 0.0]).apply(found.reshape(-1, 3)).reshape(found.shape)
    return turned


def _correlation(truth: Floats, found: Floats) -> float:
    return float(np.mean([np.corrcoef(truth[:, axis], found[:, axis])[0, 1] for axis in range(3)]))


if __name__ == "__main__":
    for title, errors, by_movement in (
        ("The sensors' own errors", SensorErrors(), False),
        ("Worn on skin, after a rough pose", WORN, False),
        ("The sensors' own errors, calibrated from movement", SensorErrors(), True),
    ):
        found = joint_accuracy((simulate_arm(seed, errors=errors) for seed in SEEDS), by_movement)
        print(f"{title}\n\n{table(found)}\n")
