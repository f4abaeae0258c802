"""How an inertial sensor sits on its segment, and how its earth stands in the room: learnt while cameras see the bones.

A bone's vector in the room is v = R q b: q turns from the sensor into the earth that its filter believes in (z up,
heading its own), R from that earth into the room, and b is the bone in the sensor's axes. Both are unknown, and
Σ |v − R q b|² is least where, by turns,

    b = mean of q' R' v                      for every bone of the segment
    R = the rotation nearest to Σ v (q b)'   (Wahba's problem)

Both need only the sums Σ v ⊗ q, so the fit is recursive and forgets: R follows the heading's drift. |b| is the bone's
length; noise of the cameras does not lengthen it, as it averages vectors. How well (R, b) are known comes from
Fisher's information of the same samples, so poses never seen have wide bounds.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fusion.geometry import skew
from fusion.messages import Floats

Flags = NDArray[np.bool_]

MEMORY_S: Final = 40.0
EVERY_S: Final = 0.1
"""Cameras' errors last for a third of a second: more often tells nothing new."""
CORRELATED: Final = 4.0
"""So many samples count as one."""
LEAST_SAMPLES: Final = 30.0
SOLVE_EVERY_S: Final = 0.5
FADE_AT_MOST_S: Final = 1.0
"""Nothing is forgotten while cameras see nothing."""
UP_STD_RAD: Final = 0.15
"""The room's y is the reference camera's, which may look up or down by so much."""
UNLEARNT_BONE_M: Final = 0.3
"""What a bone's vector may be before anything is known (one sigma per axis)."""
LEAST_STD_M: Final = 0.02
"""No camera is better than this, however smooth it looks."""
SIGMAS: Final = 3.0
SKIN_RAD: Final = 0.12
"""How far skin and straps let a sensor turn against its bone, and the filter's inclination errs."""
DRIFT_RAD_S: Final = 0.002
"""How fast a heading may drift while no camera watches."""
UP_IN_ROOM: Final = np.array([0.0, 1.0, 0.0])
UP_IN_EARTH: Final = np.array([0.0, 0.0, 1.0])
UP_WEIGHT: Final = 0.5
"""What up is worth in the fit, in m²: as five samples of an upper arm."""
ROUNDS: Final = 6
_UPRIGHT: Final = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
_HEADINGS: Final = np.stack(
    [np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]]) @ _UPRIGHT for c, s in ((1, 0), (0, 1), (-1, 0), (0, -1))]
)


@dataclass(frozen=True, slots=True)
class Attitude:
    """What is known of one sensor with B bones on its segment."""

    t_s: float
    """When cameras last saw any of the bones beside it; -inf never."""
    solved_s: float
    sums: Floats  # (B, 3, 3, 3) Σ v_i q_jk
    squares: Floats  # (B,) Σ |v|²
    count: Floats  # (B,) faded number of samples
    information: Floats  # (3 + 3 B, 3 + 3 B) of a turn in the room, and of the bones in the sensor; noise of 1 m
    earth_to_room: Floats  # (3, 3) R
    bones: Floats  # (B, 3) m in the sensor
    noise_m: float
    """Standard deviation of what is left, per axis."""

    @property
    def known(self) -> bool:
        """Whether every bone was seen often enough."""
        return bool((self.count >= LEAST_SAMPLES).all())


def unknown(bones: int) -> Attitude:
    """Before anything was seen."""
    size = 3 + 3 * bones
    return Attitude(
        -np.inf,
        -np.inf,
        np.zeros((bones, 3, 3, 3)),
        np.zeros(bones),
        np.zeros(bones),
        np.zeros((size, size)),
        _UPRIGHT,
        np.zeros((bones, 3)),
        LEAST_STD_M,
    )


def learn(attitude: Attitude, t_s: float, sensor_to_earth: Floats, vectors: Floats, seen: Flags) -> Attitude:
    """Take what cameras say of the bones.

    Args:
        attitude: what is known.
        t_s: of the sample.
        sensor_to_earth: (3, 3) q at that time.
        vectors: (B, 3) m, from each bone's parent to its child in the room.
        seen: (B,) whether cameras saw both ends.
    """
    if not seen.any() or t_s < attitude.t_s + EVERY_S:
        return attitude
    keep = float(np.exp(-min(t_s - attitude.t_s, FADE_AT_MOST_S) / MEMORY_S))
    vectors = np.where(seen[:, None], vectors, 0.0)
    taken = replace(
        attitude,
        t_s=t_s,
        sums=keep * attitude.sums + vectors[:, :, None, None] * sensor_to_earth,
        squares=keep * attitude.squares + np.sum(vectors**2, axis=1),
        count=keep * attitude.count + seen,
        information=keep * attitude.information + _information(attitude, sensor_to_earth, seen),
    )
    return _solved(taken) if t_s >= attitude.solved_s + SOLVE_EVERY_S else taken


def vectors_in_room(attitude: Attitude, sensor_to_earth: Floats) -> Floats:
    """(B, 3) m, R q b."""
    vectors: Floats = attitude.bones @ (attitude.earth_to_room @ sensor_to_earth).T
    return vectors


def tolerances_m(attitude: Attitude, sensor_to_earth: Floats, t_s: float) -> Floats:
    """(B,) m, how far each bone's vector may be off at `t_s`.

    Three standard deviations of what (R, b) leave open in this pose; and skin and drift, as a share of the length.
    """
    variance = attitude.noise_m**2 * CORRELATED
    covariance = variance * np.linalg.inv(attitude.information + variance * np.diag(_prior(len(attitude.bones))))
    rows = _jacobians(attitude, sensor_to_earth)
    spread = np.linalg.eigvalsh(rows @ covariance @ rows.transpose(0, 2, 1))[:, -1]
    drift_rad = SKIN_RAD + DRIFT_RAD_S * max(t_s - attitude.t_s, 0.0)
    tolerances: Floats = SIGMAS * np.sqrt(spread) + drift_rad * np.linalg.norm(attitude.bones, axis=1)
    return tolerances


def _information(attitude: Attitude, sensor_to_earth: Floats, seen: Flags) -> Floats:
    rows = _jacobians(attitude, sensor_to_earth)[seen]
    return np.asarray(np.einsum("bip,biq->pq", rows, rows))


def _jacobians(attitude: Attitude, sensor_to_earth: Floats) -> Floats:
    """(B, 3, 3 + 3 B) of v by a turn ε in the room, −[v]×, and by b, R q."""
    count = len(attitude.bones)
    rows = np.zeros((count, 3, 3 + 3 * count))
    rows[:, :, :3] = -skew(vectors_in_room(attitude, sensor_to_earth))
    for bone in range(count):
        rows[bone, :, 3 + 3 * bone : 6 + 3 * bone] = attitude.earth_to_room @ sensor_to_earth
    return rows


def _prior(bones: int) -> Floats:
    """(3 + 3 B,) information before any sample: a small tilt, any heading, a bone no longer than bones are."""
    turn = np.array([UP_STD_RAD, np.pi, UP_STD_RAD])
    return np.concatenate([turn, np.full(3 * bones, UNLEARNT_BONE_M)]) ** -2.0


def _solved(attitude: Attitude) -> Attitude:
    """R and b by turns, from where they were and from four headings; the best fit counts."""
    count = np.maximum(attitude.count, 1e-9)[None, :, None]
    up = UP_WEIGHT * np.outer(UP_IN_ROOM, UP_IN_EARTH)
    turns = np.stack([attitude.earth_to_room, *_HEADINGS])  # (S, 3, 3)
    for _ in range(ROUNDS):
        bones = np.einsum("bijk,sij->sbk", attitude.sums, turns) / count
        turns = _nearest_rotations(np.einsum("bijk,sbk->sij", attitude.sums, bones) + up)
    bones = np.einsum("bijk,sij->sbk", attitude.sums, turns) / count
    fit = np.sum(attitude.count[:, None] * bones**2, axis=(1, 2)) + 2 * np.einsum("sij,ij->s", turns, up)
    best = int(np.argmax(fit))
    left = attitude.squares.sum() - np.sum(attitude.count[:, None] * bones[best] ** 2)
    noise_m = max(float(np.sqrt(max(left, 0.0) / (3 * attitude.count.sum()))), LEAST_STD_M)
    return replace(attitude, solved_s=attitude.t_s, earth_to_room=turns[best], bones=bones[best], noise_m=noise_m)


def _nearest_rotations(matrices: Floats) -> Floats:
    """(S, 3, 3) the rotations that maximise trace(R' M)."""
    u, _, vt = np.linalg.svd(matrices)
    u[:, :, 2] *= np.sign(np.linalg.det(u @ vt))[:, None]
    return np.asarray(u @ vt)
