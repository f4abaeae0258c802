"""What a person reads after a slip: exit code 2, one sentence, no traceback, as docs/bad-input.md has it."""

import json
import socket
import sqlite3
import subprocess
import sys
from pathlib import Path

import pytest

from fusion.recording.writer import write_recording
from fusion.virtual_patient.trial import virtual_recording

PAGE = Path(__file__).parents[3] / "docs" / "bad-input.md"
EXAMPLES = PAGE.parents[1] / "examples" / "exoskeletons"
COMMAND = [sys.executable, "-W", "error", "-c", "from server.cli.main import main; main()"]


def said_by(folder, *words, port=None):
    """Run the command in `folder`; its sentence, with the port and the folder's own path left out."""
    command = [*COMMAND, *map(str, words)]
    ended = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=120, stdin=subprocess.DEVNULL)
    assert ended.returncode == 2, ended.stderr
    assert ended.stdout.strip() == ""
    assert "Traceback" not in ended.stderr
    sentence = ended.stderr.strip().splitlines()[-1].replace(f"{folder.resolve()}/", "")
    return sentence if port is None else sentence.replace(str(port), "PORT")


@pytest.fixture(scope="module")
def page():
    return PAGE.read_text("utf-8").replace("\\|", "|")


@pytest.fixture
def recording(tmp_path):
    write_recording(virtual_recording(1, 0.5), tmp_path / "exercise")
    return "exercise"


def break_a_line(folder):
    manifest = json.loads((folder / "recording.json").read_text())
    manifest["streams"][0]["file"] = "broken.csv"
    (folder / "recording.json").write_text(json.dumps(manifest))
    (folder / "broken.csv").write_text("t_s,body,joint,x_m,y_m,z_m,state\n0.0,1,Head,0.1,abc,2.0,2\n")


@pytest.mark.parametrize(
    "words",
    [
        ("fuse", "nowhere", "--out", "out"),
        ("fuse", "exercise", "--out", "notes.txt"),
        ("fuse", "exercise", "--out", "out", "--reference", "nobody"),
        ("convert", "garbage.mcap", "out"),
        ("convert", "exercise", "notes.txt"),
        ("replay", "exercise", "--to", "127.0.0.1:99999"),
        ("replay", "exercise", "--to", "nobody.invalid"),
        ("score", "notes.txt"),
        ("score", "nowhere.mcap"),
        ("serve", "--config", "none.toml"),
        ("serve", "--config", "wrong-key.toml"),
        ("serve", "--config", "wrong-value.toml"),
        ("serve", "--config", "notes.txt"),
        ("serve", "--data", "notes.txt"),
        ("serve", "--config", "with-arm.toml"),
        ("exoskeleton", "check", "none.toml"),
        ("exoskeleton", "check", "arm.toml"),
        ("exoskeleton", "wizard", "robot.toml"),
        ("emulate", "cia402", "--exoskeleton", "robot.toml"),
        ("experiments",),
        ("experiments", "--out", "out", "--recordings", "nowhere"),
        ("experiments", "--out", "out", "--recordings", "exercise"),
    ],
    ids=" ".join,
)
def test_the_sentence_is_the_one_on_the_page(tmp_path, recording, page, words):
    (tmp_path / "notes.txt").write_text("some notes")
    (tmp_path / "garbage.mcap").write_bytes(bytes(range(256)) * 20)
    (tmp_path / "wrong-key.toml").write_text("[station]\nrate = 100\n")
    (tmp_path / "wrong-value.toml").write_text('[station]\nrate_hz = "fast"\n')
    (tmp_path / "with-arm.toml").write_text('[station]\nexoskeleton = "arm.toml"\n')
    (tmp_path / "arm.toml").write_text((EXAMPLES / "simulated.toml").read_text().replace("sign = 1 ", "", 1))
    (tmp_path / "robot.toml").write_text((EXAMPLES / "rosbridge-seven-joints.toml").read_text())
    assert f"| `{' '.join(words)}` | {said_by(tmp_path, *words)} |" in page
    assert (tmp_path / "notes.txt").read_text() == "some notes"


def test_a_broken_line_is_named(tmp_path, recording, page):
    break_a_line(tmp_path / recording)
    assert said_by(tmp_path, "fuse", recording, "--out", "out") in page


def test_evaluating_without_truth_says_what_to_do_instead(tmp_path, recording, page):
    manifest = json.loads((tmp_path / recording / "recording.json").read_text())
    manifest["streams"] = [stream for stream in manifest["streams"] if stream["kind"] != "truth"]
    (tmp_path / recording / "recording.json").write_text(json.dumps(manifest))
    assert said_by(tmp_path, "evaluate", recording) in page


def make_garbage(database):
    database.write_text("somebody's notes " * 100)


def make_newer(database):
    with sqlite3.connect(database) as made:
        made.execute("create table alembic_version (version_num varchar(32) primary key)")
        made.execute("insert into alembic_version values ('9999')")
    made.close()


@pytest.mark.parametrize("make", [make_garbage, make_newer, Path.mkdir], ids=["garbage", "newer", "folder"])
def test_a_database_that_cannot_be_opened_is_named_and_left_as_it_is(tmp_path, page, make):
    database = tmp_path / "data" / "mirrorlimb.sqlite"
    database.parent.mkdir()
    make(database)
    assert said_by(tmp_path, "serve", "--port", "0", "--data", "data") in page
    if make is make_newer:
        with sqlite3.connect(database) as kept:
            assert kept.execute("select version_num from alembic_version").fetchall() == [("9999",)]
        kept.close()
    if make is make_garbage:
        assert database.read_text().startswith("somebody's notes")


def test_a_robot_that_nobody_answers_for_is_named_once(tmp_path, page):
    with socket.create_server(("127.0.0.1", 0)) as gone:
        port = gone.getsockname()[1]
    text = (EXAMPLES / "rosbridge-seven-joints.toml").read_text().replace("9091", str(port))
    (tmp_path / "robot.toml").write_text(text)
    ports = "[station.sensors.ports]\nk2s = 0\n"
    (tmp_path / "config.toml").write_text(f'port = 0\n[station]\nexoskeleton = "robot.toml"\n{ports}')
    assert said_by(tmp_path, "serve", "--config", "config.toml", "--data", "data", port=port) in page


def test_a_web_port_in_use_is_named(tmp_path, page):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        assert said_by(tmp_path, "serve", "--port", port, "--data", "data", port=port) in page


def test_what_the_station_cannot_start_with_is_said_once(tmp_path, page):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", 0))
        port = taken.getsockname()[1]
        (tmp_path / "config.toml").write_text(f"port = 0\n[station.sensors.ports]\nk2s = {port}\n")
        said = said_by(tmp_path, "serve", "--config", "config.toml", "--data", "data", port=port)
    assert said in page
    assert said.count("Try:") == 1
