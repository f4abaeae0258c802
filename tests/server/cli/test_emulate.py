"""`mirrorlimb emulate`: a device in a process of its own that the station's drive can be tried on."""

from __future__ import annotations

import re
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

from server.exoskeleton_file import read_exoskeleton
from server.station.exo.drives import make_drive

EXAMPLES = Path(__file__).parents[3] / "examples" / "exoskeletons"
EXAMPLE = EXAMPLES / "rosbridge-seven-joints.toml"
COMMAND = [sys.executable, "-c", "from server.cli.main import main; main()", "emulate"]


def test_a_drive_moves_the_emulated_robot_and_a_typed_line_makes_it_fail(tmp_path, unused_tcp_port) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(EXAMPLE.read_text("utf-8").replace(":9091", f":{unused_tcp_port}"), "utf-8")
    words = [*COMMAND, "rosbridge", "--exoskeleton", path]
    with subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1) as emulated:
        assert f"listens at ws://127.0.0.1:{unused_tcp_port}" in emulated.stdout.readline()
        with make_drive(read_exoskeleton(path)) as drive:
            assert drive.read(time.monotonic()).fault == ""
            emulated.stdin.write("silent\n")
            assert "silent=True" in emulated.stdout.readline()
            time.sleep(0.15)
            assert "s old" in drive.read(time.monotonic()).fault
        emulated.terminate()


def test_emulated_nodes_are_opened_over_a_bus_between_processes(tmp_path, unused_tcp_port) -> None:
    text = (EXAMPLES / "cia402-four-joints.toml").read_text("utf-8").replace('"socketcan"', '"socketcand"')
    path = tmp_path / "mine.toml"
    options = f'options = {{ host = "127.0.0.1", port = {unused_tcp_port} }}'
    path.write_text(text.replace("options = {}", options), "utf-8")
    words = [*COMMAND, "cia402", "--exoskeleton", path]
    with subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1) as emulated:
        assert "listens at socketcand" in emulated.stdout.readline()
        with make_drive(read_exoskeleton(path)) as drive:
            assert drive.read(time.monotonic()).angle_rad == pytest.approx((0.9, 0.4, 0.2, 1.0), abs=0.01)
            emulated.stdin.write("nonsense elbow\n")
            assert "is no order" in emulated.stdout.readline()
        emulated.terminate()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["cia402", "--exoskeleton", str(EXAMPLE)], "drive is 'rosbridge'.*emulate rosbridge"),
        (["rosbridge", "--exoskeleton", "nowhere.toml"], "nowhere.toml.*cannot be read"),
    ],
)
def test_what_cannot_be_emulated_is_said_in_one_sentence(tmp_path, words, said) -> None:
    ended = subprocess.run([*COMMAND, *words], cwd=tmp_path, capture_output=True, text=True, timeout=60)
    assert ended.returncode == 2
    assert "Traceback" not in ended.stderr
    assert re.search(said, ended.stderr)


def test_a_port_that_is_taken_is_said(tmp_path) -> None:
    path = tmp_path / "mine.toml"
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        path.write_text(EXAMPLE.read_text("utf-8").replace(":9091", f":{port}"), "utf-8")
        words = [*COMMAND, "rosbridge", "--exoskeleton", path]
        ended = subprocess.run(words, capture_output=True, text=True, timeout=60)
    assert ended.returncode == 2
    assert "Traceback" not in ended.stderr
    assert f"Port {port} cannot be used" in ended.stderr


def test_an_emulated_robot_stays_on_this_machine(tmp_path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(EXAMPLE.read_text("utf-8").replace("127.0.0.1:9091", "192.168.7.2:9091"), "utf-8")
    ended = subprocess.run(
        [*COMMAND, "rosbridge", "--exoskeleton", path], capture_output=True, text=True, timeout=60, cwd=tmp_path
    )
    assert ended.returncode == 2
    assert "192.168.7.2" in ended.stderr
