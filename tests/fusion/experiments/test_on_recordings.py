"""The experiments that need recordings, on a virtual patient's; and the long one, in a short form."""

from dataclasses import replace

import pytest

from fusion.align.opposed import Opposition
from fusion.estimation import METHODS
from fusion.experiments.catalogue import covered_90deg, measures_trust, numerics, truth, yao_swaps, yao_untracked
from fusion.experiments.experiment import Setup
from fusion.experiments.measures.agreement import agreements
from fusion.experiments.measures.oracle import without_wrong_joints
from fusion.experiments.measures.turning import turned
from fusion.experiments.shelf import Shelf
from fusion.recording.recording import SkeletonStream
from fusion.recording.writer import write_recording
from fusion.skeleton import INDEX, TrackingState
from fusion.virtual_patient.trial import virtual_recording

ELBOW = INDEX["ElbowRight"]


@pytest.fixture(scope="module")
def recording():
    return virtual_recording(5, 7.0)


@pytest.fixture(scope="module")
def setup(recording, tmp_path_factory):
    folder = tmp_path_factory.mktemp("recordings")
    for name in ("dual-kinect-truth-virtual", "dual-kinect-study99-90deg"):
        write_recording(replace(recording, name=name), folder / name)
    return Setup(effort=0.05, shelf=Shelf(folder))


def test_truth_scores_every_method_and_the_oracle(setup):
    outcome = truth.run(setup)
    tables = {table.name: table for table in outcome.tables}
    assert [row[0] for row in tables["all-whole"].rows][: len(METHODS)] == list(METHODS)
    told = {row[0] for row in tables["oracle"].rows}
    assert told == {"nothing", *(f"joints more than {mm} mm off" for mm in (150, 100, 50))}
    assert "dual-kinect-truth-virtual-joints" in tables


def test_the_oracle_takes_out_what_is_wrong_and_nothing_else(recording):
    def wrong_elbow(sample):
        positions = sample.positions_in_sensor.copy()
        positions[ELBOW] += 0.5
        return replace(sample, positions_in_sensor=positions)

    first, second = recording.skeleton_streams
    spoilt = SkeletonStream(second.sensor, False, second.clock, tuple(wrong_elbow(s) for s in second.samples))
    told = without_wrong_joints(replace(recording, skeleton_streams=(first, spoilt)), 0.15)
    samples = told.skeleton_streams[1].samples[5:-5]  # the truth covers these
    assert {sample.state[ELBOW] for sample in samples} == {TrackingState.LOST}
    assert TrackingState.LOST not in {sample.state[INDEX["Head"]] for sample in samples}


def test_covering_is_told_of_every_method_with_both_sensors(setup):
    outcome = covered_90deg.run(setup)
    moved, steady = outcome.tables
    assert {row[1] for row in moved.rows} == set(METHODS)
    assert {row[2] for row in moved.rows} == {"virtual-1", "virtual-2"}
    assert {row[1] for row in steady.rows} == {*METHODS, "virtual-1 alone", "virtual-2 alone"}
    assert outcome.beside[0].met is not None


def test_fusion_leaves_fewer_joints_untracked_than_either_sensor():
    scenes = [turned(1, facing_deg, 6.0).scene for facing_deg in (0.0, 90.0)]
    for found in yao_untracked.unseen(scenes).values():
        for kind in yao_untracked.TYPES:
            assert found["fused"][kind] <= min(found[name][kind] for name in yao_untracked.SENSORS)


def test_a_hidden_arm_is_better_told_by_two_sensors_than_by_one():
    found = yao_untracked.far_arm(turned(1, yao_untracked.SIDE_ON_DEG, 8.0))
    assert found.fused_mm < found.alone_mm


def test_nobody_who_sits_has_walked_and_the_goals_are_those_of_walking(setup):
    (table,) = yao_swaps.run(setup).tables
    assert [row[:2] for row in table.rows] == [("study99-90deg", 0)]
    goals = yao_swaps._beside(Opposition(100, 20, 1, 3, 200, 30, 6))
    assert [beside.met for beside in goals] == [None, False, True]


def test_sets_stay_sets_whatever_is_fed():
    outcome = numerics.run(Setup(effort=0.001))
    assert [beside.met for beside in outcome.beside] == [True] * len(numerics.METHODS_WITH_SETS)
    (table,) = outcome.tables
    assert all(row[1] == 1000 and row[2] == 100 for row in table.rows)


def test_figures_of_the_truth_itself_are_trusted_without_limit(recording):
    for measured, true in measures_trust.sessions_of(recording, together=True):
        assert {metric.name for metric in true} <= set(measures_trust.COMPARED)
        exact = agreements([(true, true)] * 5)
        assert all(one.off == 0.0 for one in exact)
        assert {metric.name for metric in measured} & {"movement_time", "range_of_movement"}
