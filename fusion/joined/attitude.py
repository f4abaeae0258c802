"""How an inertial sensor sits on its segment, and how its earth stands in the room: learnt while cameras see the bones.

A bone's vector in the room is v = R q b: q turns from the sensor into the earth that its filter believes in (z up,
heading its own), R from that earth into the room, and b is the bone in the sensor's axes. R and b are fitted to what
cameras say of v (`bone_fit`), recursively and with a memory, so that R follows the heading's drift. |b| is the bone's
length; noise of the cameras does not lengthen it, as it averages vectors. How well (R, b) are known is Fisher's
information of the same samples, from Σ q ⊗ q at the newest fit, so poses never seen have wide bounds. (Summed up as
samples came, each at the fit of its time, it would believe in what only changed fits had shown.)
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from fusion.geometry import skew
from fusion.joined.bone_fit import UPRIGHT, Sums, fit
from fusion.messages import Flags, Floats

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
SIGMAS: Final = 3.0
SKIN_RAD: Final = 0.12
"""How far skin and straps let a sensor turn against its bone, and the filter's inclination errs."""
DRIFT_RAD_S: Final = 0.002
"""How fast a heading may drift while no camera watches."""
LEVI_CIVITA: Final = -skew(np.eye(3))
"""(w × x)_i = Σ ε_ikm w_k x_m."""


@dataclass(frozen=True, slots=True)
class Attitude:
    """What is known of one sensor with B bones on its segment."""

    t_s: float
    """When cameras last saw any of the bones beside it; -inf never."""
    solved_s: float
    sums: Sums
    turns: Floats  # (B, 3, 3, 3, 3) Σ q_ij q_kl
    earth_to_room: Floats  # (3, 3) R
    bones: Floats  # (B, 3) m in the sensor
    covariance: Floats  # (3 + 3 B, 3 + 3 B) of a turn of the earth (rad) and of the bones (m)

    @property
    def known(self) -> bool:
        """Whether every bone was seen often enough."""
        return bool((self.sums.count >= LEAST_SAMPLES).all())


def unknown(bones: int) -> Attitude:
    """Before anything was seen."""
    return Attitude(
        -np.inf,
        -np.inf,
        Sums.nothing(bones),
        np.zeros((bones, 3, 3, 3, 3)),
        UPRIGHT,
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
        sums=Sums(
            keep * attitude.sums.products + vectors[:, :, None, None] * sensor_to_earth,
            keep * attitude.sums.squares + np.sum(vectors**2, axis=1),
            keep * attitude.sums.count + seen,
        ),
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
        information[own, own] = attitude.sums.count[bone] * np.eye(3)
    return np.asarray(np.linalg.inv(information / (noise_m**2 * CORRELATED) + np.diag(_prior(count))))


def _prior(bones: int) -> Floats:
    """(3 + 3 B,) information before any sample: a small tilt, any heading, a bone no longer than bones are."""
    turn = np.array([UP_STD_RAD, UP_STD_RAD, np.pi])
    return np.concatenate([turn, np.full(3 * bones, UNLEARNT_BONE_M)]) ** -2.0


def _solved(attitude: Attitude) -> Attitude:
    found = fit(attitude.sums, attitude.earth_to_room)
    return replace(
        attitude,
        solved_s=attitude.t_s,
        earth_to_room=found.earth_to_room,
        bones=found.bones,
        covariance=_covariance(attitude, found.bones, found.noise_m),
    )
