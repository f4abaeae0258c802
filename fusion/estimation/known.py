"""All that the default estimator knows: records of joints, of what each sensor says of them, of bones."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from fusion.compiled import Records, kernel, record
from fusion.estimation import ball, bias, biased_filter, bones, gated_filter, motion_set, tremor, trust
from fusion.messages import Floats

JOINT: Final = record([*biased_filter.FIELDS, *motion_set.FIELDS, *ball.FIELDS])
WORD: Final = record([*trust.FIELDS, *bias.FIELDS, *tremor.FIELDS])


class Known(NamedTuple):
    """Of J joints and K sensors, with B bones between the joints.

    Every array of records costs a microsecond on its way into a kernel and out of it: few of them, whatever they hold.
    """

    joints: Records  # (J,) of JOINT
    words: Records  # (J, K) of WORD
    bias_m2: Floats  # (J, K, K) covariances of the sensors' biases on one axis
    bones: Records  # (1 + K, B) of bones.BONE: of the fused body, and as each sensor sees them


def nothing(joints: int) -> Known:
    """Before any sensor was heard."""
    return Known(
        joints=_unseen(np.zeros(joints, JOINT)),
        words=np.zeros((joints, 0), WORD),
        bias_m2=np.zeros((joints, 0, 0)),
        bones=bones.unknown(joints)[None],
    )


def acquainted(known: Known) -> Known:
    """The same with room for what is to be learnt of one sensor more."""
    joints, sensors = known.words.shape
    words = np.concatenate([known.words, np.zeros((joints, 1), WORD)], axis=1)
    bias_m2 = np.zeros((joints, sensors + 1, sensors + 1))
    bias_m2[:, :sensors, :sensors] = known.bias_m2
    _stranger(words, bias_m2)
    return known._replace(
        words=words, bias_m2=bias_m2, bones=np.concatenate([known.bones, bones.unknown(joints)[None]])
    )


@kernel
def copied(known: Known) -> Known:
    """A copy that kernels may change."""
    return Known(known.joints.copy(), known.words.copy(), known.bias_m2.copy(), known.bones.copy())


@kernel
def _unseen(joints: Records) -> Records:
    for j in range(len(joints)):
        gated_filter.forget(joints[j])
        motion_set.forget(joints[j])
        ball.forget(joints[j])
    return joints


@kernel
def _stranger(words: Records, bias_m2: Floats) -> None:
    """Nothing was heard yet of the last of the sensors."""
    joints, sensors = words.shape
    for j in range(joints):
        trust.strange(words[j, sensors - 1])
        bias.strange(words[j, sensors - 1], bias_m2[j], sensors - 1)
