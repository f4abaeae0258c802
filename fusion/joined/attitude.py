"""How an inertial sensor sits on its segment, and how its earth stands in the room: learnt while cameras see the bones.

A bone's vector in the room is v = R q b: q turns from the sensor into the earth that its filter believes in (z up,
heading its own), R from that earth into the room, and b is the bone in the sensor's axes. Both are unknown, and
Σ |v − R q b|² is least where, by turns,

    b = mean of q' R' v                      for every bone of the segment
    R = the rotation nearest to Σ v (q b)'   (Wahba's problem)

Both need only the sums Σ v ⊗ q, so the fit is recursive and forgets: R follows the heading's drift. |b| is the bone's
length; noise of the cameras does not lengthen it, as it averages vectors. How well (R, b) are known is Fisher's
information of the same samples, from Σ q ⊗ q at the newest fit, so poses never seen have wide bounds. (Summed up as
samples came, each at the fit of its time, it would believe in what only changed fits had shown.)
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
CORRELATED: Final = 4.0
"""So many samples, at ten a second, count as one."""
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
LEVI_CIVITA: Final = -skew(np.eye(3))
"""(w × x)_i = Σ ε_ikm w_k x_m."""
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
    turns: Floats  # (B, 3, 3, 3, 3) Σ q_ij q_kl
    earth_to_room: Floats  # (3, 3) R
    bones: Floats  # (B, 3) m in the sensor
    covariance: Floats  # (3 + 3 B, 3 + 3 B) of a turn of the earth (rad) and of the bones (m)

    @property
    def known(self) -> bool:
        """Whether every bone was seen often enough."""
        return bool((self.count >= LEAST_SAMPLES).all())


def unknown(bones: int) -> Attitude:
    """Before anything was seen."""
    return Attitude(
        -np.inf,
        -np.inf,
        np.zeros((bones, 3, 3, 3)),
        np.zeros(bones),
        np.zeros(bones),
        np.zeros((bones, 3, 3, 3, 3)),
        _UPRIGHT,
        np.zeros((bones, 3)),
        np.diag(1 / _prior(bones)),
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
    if not seen.any():
        return attitude
    keep = float(np.exp(-min(t_s - attitude.t_s, FADE_AT_MOST_S) / MEMORY_S))
    vectors = np.where(seen[:, None], vectors, 0.0)
    taken = replace(
        attitude,
        t_s=t_s,
        sums=keep * attitude.sums + vectors[:, :, None, None] * sensor_to_earth,
        squares=keep * attitude.squares + np.sum(vectors**2, axis=1),
        count=keep * attitude.count + seen,
        turns=keep * attitude.turns + np.multiply.outer(seen, np.multiply.outer(sensor_to_earth, sensor_to_earth)),
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
    rows = _jacobians(attitude, sensor_to_earth)
    spread = np.linalg.eigvalsh(rows @ attitude.covariance @ rows.transpose(0, 2, 1))[:, -1]
    drift_rad = SKIN_RAD + DRIFT_RAD_S * max(t_s - attitude.t_s, 0.0)
    tolerances: Floats = SIGMAS * np.sqrt(spread) + drift_rad * np.linalg.norm(attitude.bones, axis=1)
    return tolerances


def _jacobians(attitude: Attitude, sensor_to_earth: Floats) -> Floats:
    """(B, 3, 3 + 3 B) of v by a turn of the earth, −R [q b]×, and by the bone, R q."""
    count = len(attitude.bones)
    rows = np.zeros((count, 3, 3 + 3 * count))
    rows[:, :, :3] = -attitude.earth_to_room @ skew(attitude.bones @ sensor_to_earth.T)
    for bone in range(count):
        rows[bone, :, 3 + 3 * bone : 6 + 3 * bone] = attitude.earth_to_room @ sensor_to_earth
    return rows


def _covariance(attitude: Attitude, bones: Floats, noise_m: float) -> Floats:
    """Inverse of Σ J'J / σ² and prior, with w = q b: Σ (|w|² 1 − w w') of the turn, n 1 of a bone, Σ [w]× q mixed."""
    count = len(bones)
    information = np.zeros((3 + 3 * count, 3 + 3 * count))
    spread = np.einsum("bijkl,bj,bl->ik", attitude.turns, bones, bones)
    information[:3, :3] = np.trace(spread) * np.eye(3) - spread
    for bone, (turns, vector) in enumerate(zip(attitude.turns, bones, strict=True)):
        own = slice(3 + 3 * bone, 6 + 3 * bone)
        information[:3, own] = np.einsum("ikm,kjml,j->il", LEVI_CIVITA, turns, vector)
        information[own, :3] = information[:3, own].T
        information[own, own] = attitude.count[bone] * np.eye(3)
    return np.asarray(np.linalg.inv(information / (noise_m**2 * CORRELATED) + np.diag(_prior(count))))


def _prior(bones: int) -> Floats:
    """(3 + 3 B,) information before any sample: a small tilt, any heading, a bone no longer than bones are."""
    turn = np.array([UP_STD_RAD, UP_STD_RAD, np.pi])
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
    return replace(
        attitude,
        solved_s=attitude.t_s,
        earth_to_room=turns[best],
        bones=bones[best],
        covariance=_covariance(attitude, bones[best], noise_m),
    )


def _nearest_rotations(matrices: Floats) -> Floats:
    """(S, 3, 3) the rotations that maximise trace(R' M)."""
    u, _, vt = np.linalg.svd(matrices)
    u[:, :, 2] *= np.sign(np.linalg.det(u @ vt))[:, None]
    return np.asarray(u @ vt)
