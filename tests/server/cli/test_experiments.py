"""The command's own part: what it refuses, what it says, what it writes."""

import sys

import pytest
from typer.testing import CliRunner

from fusion.errors import InputError, MachineError
from server.cli.experiments import experiments
from server.cli.loopback import Loopback
from server.cli.main import app


def _run(*words):
    return CliRunner().invoke(app, ["experiments", *map(str, words)])


def test_it_writes_page_picture_table_and_markdown(tmp_path):
    found = _run("shi-square", "--effort", 0.1, "--out", tmp_path / "out", "--markdown", tmp_path / "results.md")
    assert found.exit_code == 0
    assert {"index.html", "shi-square"} == {path.name for path in (tmp_path / "out").iterdir()}
    assert "--markdown results.md" in (tmp_path / "results.md").read_text(encoding="utf-8")
    assert "radio alone" in found.output


def test_recordings_that_are_missing_are_said_and_skipped(tmp_path):
    found = _run("covered-90deg", "--out", tmp_path)
    assert found.exit_code == 0
    assert "--recordings" in found.output


def test_the_list_names_every_experiment():
    found = _run("--list")
    assert found.exit_code == 0
    assert "du-table-1" in found.output


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["nonsense", "--out", "out"], "no experiment is called 'nonsense'"),
        (["shi-square"], "--out"),
        (["shi-square", "--out", "out", "--recordings", "nowhere"], "nowhere is no folder"),
        (["shi-square", "--out", "out", "--effort", "0"], "--effort"),
    ],
)
def test_bad_input_is_refused_before_anything_is_made(words, said, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    found = _run(*words)
    assert isinstance(found.exception, InputError)
    assert said in str(found.exception)
    assert not list(tmp_path.iterdir())


def test_without_matplotlib_it_says_how_to_get_it(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    monkeypatch.setattr("server.cli.experiments.find_spec", lambda name: None)
    with pytest.raises(MachineError, match="pip install"):
        experiments(names=["shi-square"], out=tmp_path)


def test_what_goes_into_the_loopback_comes_out():
    wire = Loopback()
    wire.send(b"one")
    wire.send(b"two")
    assert [wire.receive(), wire.receive()] == [b"one", b"two"]
    wire.close()
