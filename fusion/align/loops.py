"""The loops of alignment over frames and joints, compiled; what they are for is said where they are used.

Every array is contiguous, and positions of joints that are not seen are NaN or have the weight 0.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from fusion.compiled import kernel
from fusion.messages import Floats, States


@kernel
def interpolated(
    frames_s: Floats, positions: Floats, state: States, at_s: Floats, longest_s: float
) -> tuple[Floats, States]:
    """Positions (M, J, 3) and states (M, J) at `at_s` (M,), linear between frames at most `longest_s` apart.

    NaN and state 0 where no two frames enclose the instant so closely, or the joint is lost in either.
    """
    joints = state.shape[1]
    found = np.full((len(at_s), joints, 3), np.nan)
    seen = np.zeros((len(at_s), joints), np.uint8)
    for m in range(len(at_s)):
        before, share = _between(frames_s, at_s[m], longest_s)
        for j in range(joints if before >= 0 else 0):
            seen[m, j] = min(state[before, j], state[before + 1, j])
            if seen[m, j] > 0:
                for k in range(3):
                    found[m, j, k] = _mixed(positions[before, j, k], positions[before + 1, j, k], share)
    return found, seen


@kernel
def moved_around(
    frames_s: Floats, positions: Floats, state: States, at_s: Floats, half_s: float, longest_s: float
) -> tuple[NDArray[np.float32], States]:
    """How far each joint moved (J, M) from `half_s` before to `half_s` after `at_s` (M,), and the least states.

    Interpolated as above; 0 where unknown.
    """
    joints = state.shape[1]
    moved = np.zeros((joints, len(at_s)), np.float32)
    least = np.zeros((joints, len(at_s)), np.uint8)
    for m in range(len(at_s)):
        a, share_a = _between(frames_s, at_s[m] - half_s, longest_s)
        b, share_b = _between(frames_s, at_s[m] + half_s, longest_s)
        for j in range(joints if min(a, b) >= 0 else 0):
            least[j, m] = min(state[a, j], state[a + 1, j], state[b, j], state[b + 1, j])
            if least[j, m] > 0:
                square = 0.0
                for k in range(3):
                    behind = _mixed(positions[a, j, k], positions[a + 1, j, k], share_a)
                    square += (_mixed(positions[b, j, k], positions[b + 1, j, k], share_b) - behind) ** 2
                moved[j, m] = math.sqrt(square)
    return moved, least


@kernel
def _between(frames_s: Floats, at_s: float, longest_s: float) -> tuple[int, float]:
    """The frame before an instant and the share of the way to the next one; -1 where they are too far apart."""
    after = min(max(int(np.searchsorted(frames_s, at_s)), 1), len(frames_s) - 1)
    span_s = frames_s[after] - frames_s[after - 1]
    if not (0 < span_s < longest_s and frames_s[after - 1] <= at_s <= frames_s[after]):
        return -1, 0.0
    return after - 1, (at_s - frames_s[after - 1]) / span_s


@kernel
def _mixed(a: float, b: float, share: float) -> float:
    return (1 - share) * a + share * b


@kernel
def paired(
    reference: Floats, sensor: Floats, velocity: Floats, weight: Floats
) -> tuple[Floats, Floats, Floats, Floats]:
    """Copies of positions (N, J, 3), velocities and weights (N, J) with zeros where a position is not known.

    An unknown velocity alone is zero and takes no weight away.
    """
    ours, theirs, speed, kept = np.zeros_like(reference), np.zeros_like(sensor), np.zeros_like(velocity), weight.copy()
    for n in range(weight.shape[0]):
        for j in range(weight.shape[1]):
            if not np.isfinite(reference[n, j].sum() + sensor[n, j].sum()):
                kept[n, j] = 0.0
            if kept[n, j] > 0:
                ours[n, j], theirs[n, j] = reference[n, j], sensor[n, j]
                if np.isfinite(velocity[n, j].sum()):
                    speed[n, j] = velocity[n, j]
    return ours, theirs, speed, kept


@kernel
def turned(points: Floats, rotation: Floats, translation: Floats) -> Floats:
    """R p + T of points (N, 3)."""
    found = np.empty((len(points), 3))
    for n in range(len(points)):
        for k in range(3):
            found[n, k] = translation[k]
            for i in range(3):
                found[n, k] += rotation[k, i] * points[n, i]
    return found


@kernel
def distances(reference: Floats, sensor: Floats, rotation: Floats, translation: Floats) -> Floats:
    """How far (N,) the sensor's points (N, 3) are from the reference's once turned and moved."""
    there = turned(sensor, rotation, translation)
    found = np.empty(len(reference))
    for n in range(len(reference)):
        found[n] = apart(reference[n], there[n])
    return found


@kernel
def robust_weights(given: Floats, distance: Floats, tukey_m: float, huber_m: float) -> Floats:
    """Weights (N,) times Tukey's biweight, which ends at `tukey_m`, times Huber's, which falls from `huber_m` on."""
    kept = np.zeros(len(given))
    for n in range(len(given)):
        if distance[n] < tukey_m:
            biweight = (1 - (distance[n] / tukey_m) ** 2) ** 2
            kept[n] = given[n] * biweight * min(1.0, huber_m / max(distance[n], 1e-9))
    return kept


@kernel
def weighted_sums(
    reference: Floats, sensor: Floats, weight: Floats
) -> tuple[float, Floats, Floats, Floats, Floats, float]:
    """Σ w, the means r̄ and s̄, Σ w (r - r̄)(s - s̄)', Σ w (s - s̄)(s - s̄)' and Σ w |r - r̄|² over points (N, 3)."""
    total = weight.sum()
    middle, middle_sensor = _mean(reference, weight), _mean(sensor, weight)
    cross, scatter, square = np.zeros((3, 3)), np.zeros((3, 3)), 0.0
    for n in range(len(weight)):
        for k in range(3):
            r, s = reference[n, k] - middle[k], sensor[n, k] - middle_sensor[k]
            square += weight[n] * r * r
            for i in range(3):
                across = weight[n] * (sensor[n, i] - middle_sensor[i])
                cross[k, i] += r * across
                scatter[k, i] += s * across
    return total, middle, middle_sensor, cross, scatter, square


@kernel
def _mean(points: Floats, weight: Floats) -> Floats:
    mean, total = np.zeros(3), weight.sum()
    for n in range(len(weight)):
        for k in range(3):
            mean[k] += weight[n] * points[n, k]
    return mean / total if total > 0 else mean


@kernel
def clearly_crossed(
    reference: Floats, sensor: Floats, weight: Floats, other_side: NDArray[np.int64], share: float
) -> NDArray[np.bool_]:
    """Frames (N,) whose aligned joints (N, J, 3) are less than `share` as far apart once left and right are exchanged.

    Only joints that have a side count, and only where both sides are seen.
    """
    found = np.zeros(len(reference), np.bool_)
    for n in range(len(reference)):
        plain, crossed = 0.0, 0.0
        for j in range(len(other_side)):
            other = other_side[j]
            both = min(weight[n, j], weight[n, other])
            if other != j and both > 0:
                plain += both * apart(reference[n, j], sensor[n, j])
                crossed += both * apart(reference[n, j], sensor[n, other])
        found[n] = crossed < share * plain
    return found


@kernel
def offset_sums(errors: Floats, velocity: Floats, weight: Floats, tukey_m: float) -> tuple[float, float, float, float]:
    """Σ w v·v, Σ w e·v, Σ w e·e and Σ w over joints (N, J, 3), `weight` (N, J) times a biweight of the error."""
    information, change, square, total = 0.0, 0.0, 0.0, 0.0
    for n in range(weight.shape[0]):
        for j in range(weight.shape[1]):
            error, speed = errors[n, j], velocity[n, j]
            apart = _dot(error, error)
            if weight[n, j] > 0 and apart < tukey_m**2:
                kept = weight[n, j] * (1 - apart / tukey_m**2) ** 2
                information += kept * _dot(speed, speed)
                change += kept * _dot(error, speed)
                square += kept * apart
                total += kept
    return information, change, square, total


@kernel
def middle_seen(positions: Floats, state: States, joints: NDArray[np.int64]) -> Floats:
    """The upper median (3,), axis by axis, of those of the joints (J, 3) that are seen; NaN when none is."""
    in_order = np.empty((3, len(joints)))
    count = 0
    for j in joints:
        if state[j] > 0 and math.isfinite(positions[j, 0] + positions[j, 1] + positions[j, 2]):
            for k in range(3):
                _insert(in_order[k], count, positions[j, k])
            count += 1
    middle = np.full(3, np.nan)
    for k in range(3 if count else 0):
        middle[k] = in_order[k, count // 2]
    return middle


@kernel
def _insert(in_order: Floats, count: int, value: float) -> None:
    """Put a value in its place among the first `count`."""
    place = count
    while place > 0 and in_order[place - 1] > value:
        in_order[place] = in_order[place - 1]
        place -= 1
    in_order[place] = value


@kernel
def _dot(a: Floats, b: Floats) -> float:
    product: float = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    return product


@kernel
def apart(a: Floats, b: Floats) -> float:
    """Distance of two points (3,)."""
    return math.sqrt((a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2 + (a[2] - b[2]) ** 2)
