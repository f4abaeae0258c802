"""The chain's constraints hold by construction, whatever the angles."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from fusion.inertial.chain import ArmAngles, home, joint_positions
from fusion.messages import ArmLengths

LENGTHS = ArmLengths(0.31, 0.25, 0.08)
angles = st.lists(st.floats(-7.0, 7.0), min_size=7, max_size=7).map(
    lambda a: ArmAngles(np.array([a[:3]]), *(np.array([value]) for value in a[3:]))
)
metres = st.floats(0.01, 1.0)


def pose(**named: float) -> ArmAngles:
    """One instant; what is not named is zero."""
    zero = {name: 0.0 for name in ArmAngles.__dataclass_fields__}
    return ArmAngles(
        **{n: np.array([v]) for n, v in (zero | named).items() if n != "shoulder_rotvec_rad"},
        shoulder_rotvec_rad=np.array([named.get("shoulder_rotvec_rad", [0.0, 0.0, 0.0])]),
    )


@given(angles, metres, metres, metres)
def test_segments_keep_their_lengths_and_the_shoulder_its_place(
    any_angles: ArmAngles, upper_arm: float, forearm: float, hand: float
) -> None:
    (points,) = joint_positions(any_angles, ArmLengths(upper_arm, forearm, hand))
    assert_allclose(points[0], 0.0, atol=1e-15)
    assert_allclose(np.linalg.norm(np.diff(points, axis=0), axis=1), [upper_arm, forearm, hand], atol=1e-12)


@given(angles)
def test_the_elbow_angle_is_the_flexion_and_nothing_else(any_angles: ArmAngles) -> None:
    (points,) = joint_positions(any_angles, LENGTHS)
    upper, fore = points[1] - points[0], points[2] - points[1]
    cosine = upper @ fore / LENGTHS.upper_arm_m / LENGTHS.forearm_m
    assert_allclose(cosine, np.cos(any_angles.elbow_flexion_rad[0]), atol=1e-9)


def test_all_angles_zero_is_the_hanging_arm() -> None:
    assert_allclose(joint_positions(pose(), LENGTHS)[0], home(LENGTHS))
    assert_allclose(home(LENGTHS)[:, 1], [0, -0.31, -0.56, -0.64])


def test_a_bent_elbow_brings_the_hand_forward() -> None:
    (points,) = joint_positions(pose(elbow_flexion_rad=np.pi / 2), LENGTHS)
    assert_allclose(points[3], [0, -0.31, -0.33], atol=1e-12)


def test_pronation_moves_no_joint_while_the_wrist_is_straight() -> None:
    bent = joint_positions(pose(elbow_flexion_rad=1.0), LENGTHS)
    turned = joint_positions(pose(elbow_flexion_rad=1.0, pronation_rad=1.2), LENGTHS)
    assert_allclose(turned, bent, atol=1e-12)
