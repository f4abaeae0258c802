"""The virtual patient moves like a person, and its sensors are as wrong as they say and no more."""

from math import pi, radians
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from fusion.kinematics.angles import arm_points_in_trunk
from fusion.kinematics.body_frame import trunk_frame
from fusion.messages import Floats
from fusion.recording.reader import read_recording
from fusion.recording.writer import write_recording
from fusion.skeleton import BONE_INDICES, INDEX, Side, arm
from fusion.virtual_patient.anatomy import LAP, Anatomy, ArmPose, Posture, resting
from fusion.virtual_patient.movement import PEAK_OVER_MEAN, Movement, least_jerk
from fusion.virtual_patient.patient import HandGoal, PoseGoal, VirtualPatient
from fusion.virtual_patient.reaching import RANGES_RAD, clipped, pose_for_hand
from fusion.virtual_patient.sensor import DEMO, NO_NOISE, TABLE1, SensorPose, VirtualSensor, hidden_by_torso
from fusion.virtual_patient.trial import sensors_for, virtual_recording

DT_S = 1 / 60
GOAL = HandGoal((0.25, 0.0, -0.42))
poses = st.tuples(*(st.floats(low, high) for low, high in RANGES_RAD.tolist())).map(lambda angles: ArmPose(*angles))


def hand_in_trunk(pose: ArmPose, side: Side = Side.RIGHT) -> Floats:
    """From the shoulder."""
    angles = (pose.plane_rad, pose.elevation_rad, pose.rotation_rad, pose.elbow_rad)
    hand: Floats = arm_points_in_trunk(*angles, Anatomy().arm, side, np.zeros(3))[3]
    return hand


def live(patient: VirtualPatient, seconds: float, goal: HandGoal | PoseGoal | None) -> Floats:
    """(frames, 25, 3) m in the world."""
    return np.array([patient.step(DT_S, goal) for _ in range(round(seconds / DT_S))])


def healthy_hand(frames: Floats, side: Side) -> Floats:
    """(frames, 3) m in the trunk frame."""
    places = []
    for positions in frames:
        trunk = trunk_frame(positions)
        assert trunk is not None
        places.append((positions[arm(side)[3]] - trunk.origin_in_room) @ trunk.rotation_trunk_to_room)
    return np.array(places)


# ---------------------------------------------------------------- the patient


@pytest.mark.parametrize("side", Side)
def test_the_healthy_hand_comes_to_its_goal_after_a_reaction_time(side: Side) -> None:
    sign = 1.0 if side is Side.RIGHT else -1.0
    goal = HandGoal((sign * 0.25, 0.0, -0.42))
    patient = VirtualPatient(side, seed=1)
    live(patient, 1.0, None)
    distances = np.linalg.norm(healthy_hand(live(patient, 4.0, goal), side) - goal.hand_in_trunk, axis=1)
    assert_allclose(distances[:6], distances[0], atol=1e-3)
    assert distances[0] > 0.2
    assert distances[-1] < 0.01


@pytest.mark.parametrize("seed", range(5))
def test_a_missed_goal_is_mended(seed: int) -> None:
    frames = live(VirtualPatient(Side.RIGHT, seed), 4.0, GOAL)
    assert_allclose(healthy_hand(frames[-1:], Side.RIGHT)[0], GOAL.hand_in_trunk, atol=5e-3)


def test_a_reach_has_the_bell_shaped_speed_of_least_jerk() -> None:
    movement = Movement(np.zeros(4)).towards(np.array([0.0, 1.0, 0.0, 0.0]), 0.0, 1.0)
    t_s = np.linspace(0, movement.parts[0].duration_s, 501)
    speed = np.gradient([movement.pose_rad(t)[1] for t in t_s], t_s)
    assert speed[[0, -1]] == pytest.approx([0, 0], abs=1e-3)
    assert speed.argmax() == 250
    assert speed.max() == pytest.approx(PEAK_OVER_MEAN * 1.0 / movement.parts[0].duration_s, rel=1e-3)


@given(shares=st.lists(st.floats(0.05, 0.95), min_size=1, max_size=4), data=st.data())
def test_changing_ones_mind_on_the_way_is_smooth_and_ends_at_the_last_goal(
    shares: list[float], data: st.DataObject
) -> None:
    movement, t_s = Movement(LAP.as_array()), 0.0
    for share in shares:
        goal = data.draw(poses).as_array()
        before = movement.pose_rad(t_s)
        rate_before = (before - movement.pose_rad(t_s - 1e-6)) / 1e-6
        movement = movement.towards(goal, t_s, 1.0)
        assert_allclose(movement.pose_rad(t_s), before, atol=1e-9)
        assert_allclose((movement.pose_rad(t_s + 1e-6) - before) / 1e-6, rate_before, atol=1e-3)
        t_s += share * movement.parts[-1].duration_s
    assert_allclose(movement.pose_rad(t_s + 60.0), goal, atol=1e-9)


def test_least_jerk_covers_its_way_once() -> None:
    assert [least_jerk(share) for share in (-1.0, 0.0, 0.5, 1.0, 2.0)] == [0.0, 0.0, 0.5, 1.0, 1.0]


@given(pose=poses)
def test_every_place_that_the_arm_can_reach_is_reached(pose: ArmPose) -> None:
    hand = hand_in_trunk(pose)
    found = pose_for_hand(hand, Anatomy().arm, LAP)
    assert found == clipped(found)
    assert np.linalg.norm(hand_in_trunk(found) - hand) < 0.06  # a few places need a joint at the very end of its range


@given(pose=poses)
def test_a_comfortable_place_is_reached_exactly(pose: ArmPose) -> None:
    low, high = RANGES_RAD[:, 0], RANGES_RAD[:, 1]
    inner = ArmPose(*(low + (0.2 + 0.6 * (pose.as_array() - low) / (high - low)) * (high - low)).tolist())
    hand = hand_in_trunk(inner)
    assert_allclose(hand_in_trunk(pose_for_hand(hand, Anatomy().arm, LAP)), hand, atol=1e-6)


def test_a_place_out_of_reach_is_pointed_at() -> None:
    hand = hand_in_trunk(pose_for_hand(np.array([0.3, 0.0, -2.0]), Anatomy().arm, LAP))
    assert_allclose(hand / np.linalg.norm(hand), np.array([0.3, 0.0, -2.0]) / np.hypot(0.3, 2.0), atol=0.01)


@settings(max_examples=10)
@given(seed=st.integers(0, 99), posture=st.sampled_from(Posture), side=st.sampled_from(Side))
def test_bones_keep_their_lengths_and_the_head_is_on_top(seed: int, posture: Posture, side: Side) -> None:
    frames = live(VirtualPatient(side, seed, posture=posture), 1.5, PoseGoal(ArmPose(0.8, 1.4, 0.2, 0.6)))
    lengths = np.linalg.norm(frames[:, BONE_INDICES[:, 1]] - frames[:, BONE_INDICES[:, 0]], axis=-1)
    rigid = [i for i, (_, child) in enumerate(BONE_INDICES) if child not in (INDEX["ThumbLeft"], INDEX["ThumbRight"])]
    assert_allclose(lengths[:, rigid], np.broadcast_to(lengths[0, rigid], lengths[:, rigid].shape), atol=1e-9)
    assert (frames[..., 1].argmax(axis=1)[0] == INDEX["Head"]).all()
    assert frames[..., 1].min() > -0.1


def test_left_is_left_and_the_patient_faces_minus_z() -> None:
    positions = VirtualPatient(Side.RIGHT, 0).step(DT_S)
    assert positions[INDEX["ShoulderRight"], 0] > 0 > positions[INDEX["ShoulderLeft"], 0]
    assert positions[INDEX["FootLeft"], 2] < positions[INDEX["AnkleLeft"], 2]


def test_the_trunk_is_where_the_joints_say() -> None:
    patient = VirtualPatient(Side.LEFT, 3)
    found = trunk_frame(live(patient, 2.0, GOAL)[-1])
    assert found is not None
    assert_allclose(found.origin_in_room, patient.trunk.origin_in_room, atol=1e-9)
    assert_allclose(found.rotation_trunk_to_room, patient.trunk.rotation_trunk_to_room, atol=1e-9)


def test_the_affected_arm_is_where_the_exoskeleton_holds_it_or_rests() -> None:
    patient = VirtualPatient(Side.RIGHT, 0)
    held = ArmPose(0.9, 1.0, -0.2, 0.8)
    for affected, expected in ((held, held), (None, resting(Posture.SITTING))):
        positions = patient.step(DT_S, affected=affected)
        hand = (positions - patient.trunk.origin_in_room) @ patient.trunk.rotation_trunk_to_room
        shoulder, *_, tip = arm(Side.LEFT)
        assert_allclose(hand[tip] - hand[shoulder], hand_in_trunk(expected, Side.LEFT), atol=1e-9)


def test_equal_seeds_live_equal_lives() -> None:
    one, two, other = (live(VirtualPatient(Side.RIGHT, seed), 2.0, GOAL) for seed in (5, 5, 6))
    assert_array_equal(one, two)
    assert np.abs(one - other).max() > 1e-3


def test_a_less_able_patient_is_slower_and_leans_more() -> None:
    able, weak = (live(VirtualPatient(Side.RIGHT, 5, ability=ability), 1.2, GOAL) for ability in (1.0, 0.4))
    hand = INDEX["HandRight"]
    assert np.linalg.norm(weak[-1, hand] - weak[0, hand]) < np.linalg.norm(able[-1, hand] - able[0, hand])
    able, weak = (live(VirtualPatient(Side.RIGHT, 5, ability=ability), 6.0, GOAL) for ability in (1.0, 0.4))
    assert weak[-1, INDEX["Head"], 2] < able[-1, INDEX["Head"], 2] - 0.02


def test_the_trunk_sways_as_much_as_stated() -> None:
    patient = VirtualPatient(Side.RIGHT, 8)
    heads = np.array([patient.step(0.1)[INDEX["Head"]] for _ in range(6000)])
    assert heads[:, 0].std() == pytest.approx(0.012 * 0.74, rel=0.15)  # roll times the head's height over the pelvis


# ---------------------------------------------------------------- the sensors


def seen(sensor: VirtualSensor, seconds: float) -> tuple[Floats, list]:
    """Errors in the sensor's frame of what it saw of a patient who keeps still, and the samples."""
    positions = VirtualPatient(Side.RIGHT, 0).step(DT_S)
    found = (sensor.see(positions, n * DT_S) for n in range(round(seconds / DT_S)))
    samples = [sample for sample in found if sample is not None]
    errors = np.array([sample.positions_in_sensor - sensor.pose.to_sensor(positions) for sample in samples])
    return errors, samples


def test_a_sensor_looks_along_plus_z_with_x_to_the_right_of_who_faces_it() -> None:
    ahead = SensorPose.around(0.0, distance_m=2.0, height_m=1.0, tilt_rad=0.0)
    assert_allclose(ahead.to_sensor(np.array([0.5, 1.3, 0.0])), [0.5, 0.3, 2.0], atol=1e-12)
    right = SensorPose.around(pi / 2, distance_m=2.0, height_m=1.0, tilt_rad=0.0)
    assert_allclose(right.to_sensor(np.array([0.5, 1.3, 0.0])), [0.0, 0.3, 1.5], atol=1e-12)
    assert_allclose(right.to_sensor(np.array([0.0, 1.0, 0.5])), [0.5, 0.0, 2.0], atol=1e-12)


@given(azimuth=st.floats(-pi, pi), tilt=st.floats(-0.3, 0.3))
def test_every_sensor_sees_the_patient_upright_before_it(azimuth: float, tilt: float) -> None:
    pose = SensorPose.around(azimuth, tilt_rad=tilt)
    assert np.linalg.det(pose.rotation_sensor_to_world) == pytest.approx(1.0)
    positions = pose.to_sensor(VirtualPatient(Side.RIGHT, 0).step(DT_S))
    assert (positions[:, 2] > 0.9).all()
    assert positions[INDEX["Head"], 1] > positions[INDEX["SpineBase"], 1] + 0.5


def test_a_tilted_sensor_looks_down() -> None:
    level, tilted = (SensorPose.around(0.0, tilt_rad=tilt).to_sensor(np.array([0.0, 1.0, 0.0])) for tilt in (0.0, 0.1))
    assert tilted[1] > level[1]


def test_without_noise_the_truth_is_seen() -> None:
    errors, _ = seen(VirtualSensor("k", SensorPose.around(0.0), 0, noise=NO_NOISE, dropped_share=0.0), 1.0)
    assert_allclose(errors, 0.0, atol=1e-12)


def test_table_1_is_met() -> None:
    errors, _ = seen(VirtualSensor("k", SensorPose.around(0.0), 0, noise=TABLE1, dropped_share=0.0), 60.0)
    assert_allclose(errors.mean(axis=(0, 1)), TABLE1.mean_m, atol=0.003)
    assert_allclose(errors.std(axis=(0, 1)), TABLE1.std_m, rtol=0.06)
    centred = errors - np.array(TABLE1.mean_m)
    assert (np.abs(centred) <= np.array(TABLE1.interval_m) + 1e-12).all()
    follows = (centred[1:] * centred[:-1]).mean() / (centred**2).mean()
    assert follows == pytest.approx(TABLE1.correlation, abs=0.02)


def test_frames_come_at_30_hz_on_the_sensors_own_clock() -> None:
    sensor = VirtualSensor("k", SensorPose.around(0.0), 0, clock_offset_s=0.137, dropped_share=0.0)
    _, samples = seen(sensor, 10.0)
    assert len(samples) == pytest.approx(300, abs=2)
    assert_allclose([sample.t_s - sample.t_received_s for sample in samples], 0.137)
    _, some = seen(VirtualSensor("k", SensorPose.around(0.0), 0, dropped_share=0.3), 10.0)
    assert len(some) == pytest.approx(210, abs=30)


def test_the_torso_hides_the_far_arm_from_the_side_and_none_from_ahead() -> None:
    positions = VirtualPatient(Side.RIGHT, 0).step(DT_S)
    ahead, right = (SensorPose.around(azimuth).position_in_world for azimuth in (0.0, pi / 2))
    assert not hidden_by_torso(positions, ahead).any()
    hidden = hidden_by_torso(positions, right)
    assert hidden[[INDEX["ShoulderLeft"], INDEX["ElbowLeft"], INDEX["HipLeft"]]].all()
    assert not hidden[[i for name, i in INDEX.items() if not name.endswith("Left")]].any()


def test_hidden_joints_are_inferred_or_lost_and_lost_ones_have_no_place() -> None:
    _, samples = seen(VirtualSensor("k", SensorPose.around(pi / 2), 4), 1.0)
    for sample in samples:
        assert sample.state[INDEX["ShoulderLeft"]] < 2
        assert sample.state[INDEX["ShoulderRight"]] == 2
        assert_array_equal(np.isnan(sample.positions_in_sensor).all(axis=1), sample.state == 0)


# ---------------------------------------------------------------- a recording with truth


def test_a_virtual_recording_is_read_back_with_its_truth(tmp_path: Path) -> None:
    made = virtual_recording(2, 4.0, noise=DEMO)
    write_recording(made, tmp_path / "virtual")
    recording = read_recording(tmp_path / "virtual")
    assert [len(stream.samples) for stream in recording.skeleton_streams] == pytest.approx([119, 119], abs=5)
    assert recording.truth is not None
    sample = recording.skeleton_streams[0].samples[60]
    truth = np.array(
        [np.interp(sample.t_s, recording.truth.t_s, recording.truth.positions[:, 0, axis]) for axis in range(3)]
    )
    assert np.abs(sample.positions_in_sensor[INDEX["SpineBase"]] - truth).max() < 0.06


def test_the_second_sensor_stands_at_the_healthy_side_with_its_own_clock() -> None:
    for side, sign in ((Side.LEFT, -1), (Side.RIGHT, 1)):
        _, second = sensors_for(side, 0, clock_offset_s=0.1, apart_rad=radians(85))
        assert np.sign(second.pose.position_in_world[0]) == sign
        assert second.clock_offset_s == 0.1
