"""What the virtual patient wears: inertial sensors that follow the segments, a tag with the ranges of the waist."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from fusion.inertial.orientation import Inertial, orient
from fusion.inertial.simulation import GRAVITY_M_S2, SensorErrors
from fusion.recording.folder import read_folder
from fusion.recording.recording import Recording
from fusion.recording.writer import write_recording
from fusion.skeleton import INDEX, JOINTS, Side
from fusion.virtual_patient.patient import VirtualPatient
from fusion.virtual_patient.stroll import Stroll
from fusion.virtual_patient.tag import TagErrors
from fusion.virtual_patient.trial import virtual_recording
from fusion.virtual_patient.worn import segment_poses, sites_on

PERFECT = SensorErrors(0.0, 0.0, 0.0, 0.0)
EXACT = TagErrors(0.0, 0.0, 0.0, blocked_share=0.0)
LENGTH_S = 6.0


@pytest.fixture(scope="module")
def perfect() -> Recording:
    return virtual_recording(2, LENGTH_S, worn=PERFECT, tag=EXACT, stroll_m=0.1)


@pytest.mark.parametrize("side", list(Side))
def test_segments_run_along_their_bones(side: Side) -> None:
    patient = VirtualPatient(side, 1)
    positions = patient.step(0.01)
    poses = segment_poses(positions, patient.trunk, patient.healthy_pose, side)
    names = [(f"{a}{side.suffix}", f"{b}{side.suffix}") for a, b in (("Shoulder", "Elbow"), ("Elbow", "Wrist"))]
    for rotation, (parent, child) in zip(poses.rotations[1:3], names, strict=True):
        bone = positions[INDEX[child]] - positions[INDEX[parent]]
        assert_allclose(rotation @ [0.0, -1.0, 0.0], bone / np.linalg.norm(bone), atol=1e-9)
    assert_allclose(poses.rotations @ poses.rotations.transpose(0, 2, 1), np.tile(np.eye(3), (4, 1, 1)), atol=1e-9)
    assert_allclose(np.linalg.det(poses.rotations), 1.0)


def test_a_perfect_sensor_turns_with_its_bone(perfect: Recording) -> None:
    truth = perfect.truth
    assert truth is not None
    stream = next(stream for stream in perfect.imu_streams if stream.site == "forearm-right")
    turned = orient(Inertial(stream.site, stream.t_s, stream.gyro_rad_s, stream.accel_m_s2)).sensor_to_earth
    bone = truth.positions[1:-1, INDEX["WristRight"]] - truth.positions[1:-1, INDEX["ElbowRight"]]
    late = stream.t_s > 2.0
    in_earth_up = turned.inv().apply([0.0, 0.0, 1.0])[late]
    bone_in_sensor = np.linalg.lstsq(in_earth_up, _up_component(bone[late]), rcond=None)[0]
    assert np.linalg.norm(bone_in_sensor) == pytest.approx(0.25, abs=0.03)


def _up_component(bones: np.ndarray) -> np.ndarray:
    tilt_rad = 0.05  # of the reference sensor, whose frame the truth is in
    return bones @ [0.0, np.cos(tilt_rad), -np.sin(tilt_rad)]


def test_a_sensor_measures_gravity_on_average(perfect: Recording) -> None:
    assert [stream.site for stream in perfect.imu_streams] == list(sites_on(Side.RIGHT))
    for stream in perfect.imu_streams:
        assert np.linalg.norm(stream.accel_m_s2, axis=1).mean() == pytest.approx(GRAVITY_M_S2, rel=0.03)


def test_exact_ranges_are_the_distances_of_a_waist_that_strolls(perfect: Recording) -> None:
    (ranges,) = perfect.range_streams
    first = ranges.range_m[ranges.t_s == ranges.t_s[0]]
    away = np.linalg.norm(ranges.anchor_positions[:, None] - ranges.anchor_positions[None], axis=-1)
    assert (np.abs(first[:, None] - first[None]) <= away + 1e-9).all()  # the triangle inequality
    assert np.ptp(ranges.range_m[ranges.anchor == 0]) > 0.02


def test_blocked_links_measure_too_long() -> None:
    plain, blocked = (
        virtual_recording(2, LENGTH_S, tag=TagErrors(0.0, 0.0, 0.0, blocked_share=share)) for share in (0.0, 0.3)
    )
    longer = blocked.range_streams[0].range_m - plain.range_streams[0].range_m
    assert set(np.round(np.unique(longer), 6)) == {0.0, 0.3}


def test_equal_seeds_wear_equal_sensors_and_a_patient_without_any_lives_the_same_life() -> None:
    one, two = (virtual_recording(4, 2.0, worn=SensorErrors(), tag=TagErrors()) for _ in range(2))
    plain = virtual_recording(4, 2.0)
    assert_allclose(one.imu_streams[2].gyro_rad_s, two.imu_streams[2].gyro_rad_s)
    assert_allclose(one.range_streams[0].range_m, two.range_streams[0].range_m)
    assert one.truth is not None
    assert plain.truth is not None
    assert_allclose(one.truth.positions, plain.truth.positions)
    assert plain.imu_streams == plain.range_streams == ()


def test_somebody_who_strolls_keeps_near_their_place_at_a_walking_speed() -> None:
    path = np.array([Stroll(0.12, 5).at(t) for t in np.arange(0.0, 300.0, 0.05)])
    assert_allclose(path[:, [0, 2]].std(axis=0), 0.12, rtol=0.1)
    assert (path[:, 1] == 0).all()
    assert np.linalg.norm(np.diff(path, axis=0), axis=1).max() / 0.05 < 0.7


def test_a_recording_with_everything_is_written_and_read_back(perfect: Recording, tmp_path) -> None:
    write_recording(perfect, tmp_path / "all")
    again = read_folder(tmp_path / "all")
    assert [stream.site for stream in again.imu_streams] == [stream.site for stream in perfect.imu_streams]
    assert_allclose(again.imu_streams[1].accel_m_s2, perfect.imu_streams[1].accel_m_s2, atol=1e-6)
    assert_allclose(again.range_streams[0].range_m, perfect.range_streams[0].range_m, atol=1e-4)
    assert again.truth is not None
    assert again.truth.joints == JOINTS
