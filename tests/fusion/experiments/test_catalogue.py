"""Each experiment in a small size: what its page claims holds."""

import re

import numpy as np
import pytest

from fusion.errors import InputError, RecordingError
from fusion.estimation import METHODS
from fusion.experiments.catalogue import du_alignment, du_table_1, du_table_2
from fusion.experiments.experiment import CHAPTER_TITLES, Setup
from fusion.experiments.registry import chosen, experiments
from fusion.experiments.shelf import Shelf

SMALL = Setup(seed=2, effort=0.05)


def _figures(text):
    return [float(found) for found in re.findall(r"\d+(?:\.\d+)?", text)]


@pytest.fixture(scope="module")
def outcome_of():
    done = {}

    def run(name):
        if name not in done:
            done[name] = experiments()[name].run(SMALL)
        return done[name]

    return run


def test_every_experiment_says_what_was_done_and_what_the_paper_has():
    for name, each in experiments().items():
        assert each.name == name
        assert each.chapter in CHAPTER_TITLES
        assert min(len(each.done), len(each.paper), len(each.title)) > 10


def test_an_unknown_name_is_refused_with_the_known_ones():
    with pytest.raises(InputError, match="du-table-1"):
        chosen(experiments(), ["du-table-3"])


def test_named_experiments_come_in_the_order_of_the_page():
    assert [each.name for each in chosen(experiments(), ["shi-square", "du-table-1"])] == ["du-table-1", "shi-square"]


def test_recordings_that_nobody_gave_are_asked_for_by_their_option():
    with pytest.raises(RecordingError, match="--recordings"):
        SMALL.recordings("dual-kinect-*")


def test_a_folder_without_recordings_is_no_shelf(tmp_path):
    with pytest.raises(InputError, match="holds no recording"):
        Shelf(tmp_path)
    with pytest.raises(InputError, match="is no folder"):
        Shelf(tmp_path / "nowhere")


def test_ours_is_exact_where_the_paper_s_linear_model_ends():
    point = du_alignment.point_at(10.0, (2,), 10.0, du_alignment.NO_NOISE)
    assert point.bursa_moved > 5.0  # mm
    assert point.bursa_moved > 2 * point.bursa_here
    assert point.ours_moved < 0.5


def test_the_simulated_sensor_errs_as_table_1_says():
    law = du_table_1.simulated_law(Setup(seed=2, effort=0.5))
    assert np.allclose(law.std[:3], (45.6, 38.7, 54.1), rtol=0.2)
    assert max(law.largest[:3]) < 220.0  # interval and mean


def test_after_fusion_errors_are_smaller_than_one_sensor_s():
    laws = du_table_2.simulated_laws(Setup(effort=0.3), (2,))
    assert list(laws) == list(METHODS)
    assert all(sum(law.std[:3]) < 45.6 + 38.7 + 54.1 for law in laws.values())


def test_a_covered_lens_hardly_moves_the_fused_arm_but_its_own_sensor(outcome_of):
    _, first, second, alone = (_figures(beside.ours)[0] for beside in outcome_of("du-occlusion").beside)
    assert max(first, second) < 0.5 * alone


def test_the_filter_as_printed_explodes_with_the_bounds_of_table_1_and_ours_does_not(outcome_of):
    (table,) = outcome_of("esmf-as-printed").tables
    exploded = {(row[0], row[1]): row[2] == "exploded" for row in table.rows}
    unused = {(row[0], row[1]): row[4] for row in table.rows}
    assert exploded["200", "as printed"]
    assert exploded["200", "gain mended alone"]
    assert unused["200", "as printed"] > 90.0
    assert not exploded["20", "as printed"]
    for bound in ("20", "40", "60", "100", "200"):
        assert not exploded[bound, "esmf"]
        assert not exploded[bound, "set-membership"]


def test_the_inertial_arm_follows_the_truth_better_than_the_paper_s(outcome_of):
    ours_worn = {
        beside.what.split(":")[0]: beside for beside in outcome_of("liu-arm").beside if "correlation" in beside.what
    }
    for beside in ours_worn.values():
        assert _figures(beside.ours)[0] > _figures(beside.paper)[0]


def test_the_join_narrows_what_somebody_walking_around_does(outcome_of):
    ranges = [np.diff(_figures(beside.ours))[0] for beside in outcome_of("shi-standing").beside]
    assert ranges[2] < ranges[0]
    assert ranges[3] < ranges[1]


def test_the_square_is_walked_all_around(outcome_of):
    (table,) = outcome_of("shi-square").tables
    off_cm = {row[0]: row[1] for row in table.rows}
    assert off_cm["ours"] < off_cm["radio alone"] < 100
    assert 0 < off_cm["the paper's rule"] < 100
