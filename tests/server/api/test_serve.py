"""`serve` starts with one line, ends when asked, and says in one sentence why it cannot start."""

import json
import os
import signal
import socket
import subprocess
import sys
from pathlib import Path

import httpx
import pytest

from fusion.errors import MachineError
from server.api.data_folder import data_folder, locked
from server.api.serve import run
from server.config import Config

SERVE = [sys.executable, "-W", "error", "-c", "from server.cli.main import main; main()", "serve"]


def config_file(folder, **ports):
    """A configuration whose sensors' ports are free, but for those named."""
    every = {"kinectv2-osc": 0, "osceleton2": 0, "k2s": 0, "mirrorlimb": 0} | ports
    path = folder / "config.toml"
    lines = "\n".join(f"{json.dumps(dialect)} = {port}" for dialect, port in every.items())
    path.write_text(f"[station.sensors.ports]\n{lines}\n")
    return path


def serve(data, *more):
    return subprocess.Popen(
        [*SERVE, "--port", "0", "--data", str(data), *map(str, more)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def test_it_prints_the_address_last_serves_there_and_ends_when_asked(tmp_path):
    service = serve(tmp_path / "data", "--config", config_file(tmp_path))
    try:
        address = service.stdout.readline().strip()
        assert httpx.get(f"{address}/api/status", trust_env=False).json()["first_start"] is True
        service.send_signal(signal.SIGINT)
        rest, complaints = service.communicate(timeout=20)
    finally:
        service.kill()
        service.wait()
    assert (service.returncode, rest, complaints) == (0, "", "")


def test_a_killed_service_takes_its_station_along_and_leaves_the_folder_free(tmp_path):
    first = serve(tmp_path / "data", "--config", config_file(tmp_path))
    assert first.stdout.readline().startswith("http")
    first.kill()
    first.communicate()
    second = serve(tmp_path / "data", "--config", config_file(tmp_path))
    try:
        assert second.stdout.readline().startswith("http")
    finally:
        second.send_signal(signal.SIGINT)
        second.communicate(timeout=20)


@pytest.mark.parametrize("trouble", ["not a database", "a sensors' port in use"])
def test_what_keeps_it_from_starting_is_said_without_a_traceback(tmp_path, trouble):
    (tmp_path / "data").mkdir()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", 0))
        port = taken.getsockname()[1]
        if trouble == "not a database":
            (tmp_path / "data" / "mirrorlimb.sqlite").write_text("somebody's notes" * 100)
        named = {"k2s": port} if trouble != "not a database" else {}
        service = serve(tmp_path / "data", "--config", config_file(tmp_path, **named))
        said, complaints = service.communicate(timeout=40)
    assert service.returncode == 2
    assert said == ""
    assert "Traceback" not in complaints
    assert ("mirrorlimb.sqlite" if trouble == "not a database" else str(port)) in complaints


def test_a_web_port_in_use_is_named_with_its_remedy(tmp_path):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(MachineError, match=str(port)) as refused:
            run(Config(port=port, data=str(tmp_path)))
    assert "--port" in refused.value.remedy


def test_an_address_that_is_not_ours_is_named(tmp_path):
    with pytest.raises(MachineError, match=r"203\.0\.113\.1"):
        run(Config(host="203.0.113.1", port=0, data=str(tmp_path)))


def test_a_second_service_on_the_same_folder_is_refused(tmp_path):
    with locked(tmp_path), pytest.raises(MachineError, match="Another mirrorlimb") as refused:
        run(Config(port=0, data=str(tmp_path)))
    assert "--data" in refused.value.remedy


def test_the_lock_is_free_again_afterwards(tmp_path):
    for _ in range(2):
        with locked(tmp_path):
            pass


def test_a_folder_that_is_a_file_is_refused(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(MachineError, match="cannot be made"):
        data_folder(Config(data=str(tmp_path / "file" / "data")))


def test_nobody_else_may_look_into_the_data_folder(tmp_path):
    folder = data_folder(Config(data=str(tmp_path / "new")))
    assert folder.stat().st_mode & 0o077 == 0


def test_the_demonstration_has_a_folder_of_its_own(monkeypatch, tmp_path):
    monkeypatch.setenv("HOME", str(tmp_path))
    assert data_folder(Config(demo=True)) != data_folder(Config())
    assert Path(os.environ["HOME"]) in data_folder(Config()).parents
