"""The matrices that a method carries from step to step: sets and covariances, as they are and not as they are told."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from fusion.compiled import Records
from fusion.estimation.esmf import EsmfState
from fusion.estimation.kalman import KalmanState
from fusion.estimation.known import Known
from fusion.estimation.set_membership import SetState
from fusion.messages import Floats


def carried(snapshot: object) -> Iterator[Floats]:
    """(J, D, D) shapes and covariances in an estimator's snapshot, one stack for each kind.

    Raises:
        TypeError: the method carries no set.
    """
    match snapshot:
        case SetState():
            yield from (_two_by_two(snapshot.known.joints["on"][:, axis]) for axis in range(3))
            yield _with_biases(snapshot.known)
        case KalmanState():
            yield _two_by_two(snapshot.joints)
        case EsmfState():
            yield snapshot.joints["shape"]
        case _:
            raise TypeError(f"{type(snapshot).__name__} carries no set")


def _two_by_two(joints: Records) -> Floats:
    """(J, 2, 2) of position and velocity; only half of it is kept, so it cannot but be symmetric."""
    rows = [[joints["pp"], joints["pv"]], [joints["pv"], joints["vv"]]]
    return np.moveaxis(np.array(rows), -1, 0)


def _with_biases(known: Known) -> Floats:
    """(J, 2 + K, 2 + K) of position, velocity and K sensors' biases."""
    joints, words = known.joints, known.words
    whole = np.empty((len(joints), 2 + words.shape[1], 2 + words.shape[1]))
    whole[:, :2, :2] = _two_by_two(joints)
    whole[:, 0, 2:] = whole[:, 2:, 0] = words["with_position"]
    whole[:, 1, 2:] = whole[:, 2:, 1] = words["with_velocity"]
    whole[:, 2:, 2:] = known.bias_m2
    return whole
