"""Outcomes become files that can be read by people and by programs."""

import csv

import pytest

from fusion.errors import MachineError
from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.making import made
from fusion.experiments.outcome import Beside, Column, Outcome, Picture, Table, columns
from fusion.experiments.output.files import write_one, write_page
from fusion.experiments.output.made import Origin
from fusion.experiments.output.markdown import markdown
from fusion.experiments.output.page import page

ORIGIN = Origin("mirrorlimb experiments --out FOLDER", 1, "0", recordings=False)


def _draw(figure):
    figure.subplots().plot([0, 1], [1, 2])


def _run(setup):
    table = Table("figures", "Some <figures>", (Column("name"), Column("mm", 1)), (("a|b", 1.25), ("c", float("nan"))))
    folded = Table("details", "Details", (Column("n"),), ((1,),), folded=True)
    beside = Beside("error", "not given", "1.2 mm", met=True)
    return Outcome((beside,), (table, folded), (Picture("line", "A line", _draw),), "No reason.", (setup.seed,))


EXAMPLE = Experiment("example", Chapter.OURS, "An example", "A goal.", "Something.", _run)
NEEDY = Experiment("needy", Chapter.OURS, "Needs recordings", "A goal.", "Something.", _run, needs="no-such-*")


@pytest.fixture(scope="module")
def results():
    return list(made([EXAMPLE, NEEDY], Setup()))


def test_pictures_are_png_and_svg_and_tables_csv_beside_one_page(results, tmp_path):
    for each in results:
        write_one(each, tmp_path / "new")
    index = write_page(results, ORIGIN, tmp_path / "new")
    folder = tmp_path / "new" / "example"
    assert sorted(path.name for path in folder.iterdir()) == ["details.csv", "figures.csv", "line.png", "line.svg"]
    assert (folder / "line.png").read_bytes().startswith(b"\x89PNG")
    assert index.read_text(encoding="utf-8").startswith("<!doctype html>")
    with (folder / "figures.csv").open(newline="", encoding="utf-8") as file:
        assert list(csv.reader(file)) == [["name", "mm"], ["a|b", "1.25"], ["c", "nan"]]


def test_the_page_stands_alone_and_escapes_what_it_shows(results):
    html = page(results, ORIGIN)
    assert 'src="data:image/svg+xml;base64,' in html
    assert "Some &lt;figures&gt;" in html
    assert "http://" not in html
    assert "<script" not in html


def test_what_could_not_be_made_is_said_and_does_not_stop_the_rest(results):
    assert [each.experiment.name for each in results] == ["example", "needy"]
    assert "--recordings" in results[1].outcome.left_out[0]
    for text in (page(results, ORIGIN), markdown(results, ORIGIN)):
        assert "no-such-*" in text.replace("&#x27;", "'")


def test_markdown_folds_details_and_keeps_cells_apart(results):
    text = markdown(results, ORIGIN)
    assert "<details><summary>Details</summary>" in text
    assert "| a\\|b | 1.2 |" in text
    assert "| c | – |" in text
    assert "| example | error | not given | 1.2 mm | met |" in text


def test_equal_data_give_equal_pictures(results):
    again = next(made([EXAMPLE], Setup()))
    assert again.pictures == results[0].pictures


def test_a_folder_that_cannot_be_made_is_named(results, tmp_path):
    (tmp_path / "taken").write_text("a file")
    with pytest.raises(MachineError, match="taken"):
        write_one(results[0], tmp_path / "taken")
    with pytest.raises(MachineError, match="taken"):
        write_page(results, ORIGIN, tmp_path / "taken")


def test_numbers_stand_to_the_right_written_out_or_not():
    table = Table("t", "t", columns("a", "b", "c"), (("1.5", 2.5, "x"), ("99.1%", float("nan"), "3")))
    assert [table.is_number(k) for k in range(3)] == [True, True, False]
