"""`mirrorlimb doctor` names what is missing and what mends it."""

from __future__ import annotations

import socket

import msgspec

from server.cli.doctor import Finding, examine
from server.config import Config, SensorsConfig, StationConfig
from server.station.exo import drives


def _config(port: int = 0, udp: int = 0) -> Config:
    return Config(port=port, station=StationConfig(sensors=SensorsConfig(ports={"mirrorlimb": udp})))


def _find(config: Config, what: str) -> Finding:
    return next(finding for finding in examine(config) if finding.what.startswith(what))


def test_a_free_port_is_good() -> None:
    assert _find(_config(), "Web address").good
    assert _find(_config(), "Sensors' port (mirrorlimb)").good


def test_a_web_port_in_use_is_named_with_its_mend() -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        finding = _find(_config(port=port), "Web address")
    assert not finding.good
    assert finding.needed
    assert f":{port}" in finding.found
    assert "--port" in finding.mend


def test_a_sensors_port_in_use_is_named_with_its_key() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", 0))
        finding = _find(_config(udp=taken.getsockname()[1]), "Sensors' port (mirrorlimb)")
    assert not finding.good
    assert "[station.sensors.ports]" in finding.mend


def test_a_data_folder_that_is_a_file_is_missing(tmp_path) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("not a folder")
    finding = _find(msgspec.structs.replace(_config(), data=str(blocked / "data")), "Data folder")
    assert not finding.good
    assert "--data" in finding.mend


def test_the_exoskeleton_is_named_and_what_its_drive_lacks(monkeypatch) -> None:
    assert "'simulated'" in _find(_config(), "Exoskeleton").found
    assert _find(_config(), "Exoskeleton").good
    monkeypatch.setitem(drives.EXTRAS, "simulated", ("simulation", ("mujoco", "no_such_module")))
    finding = _find(_config(), "Exoskeleton")
    assert not finding.good
    assert "no_such_module not installed" in finding.found
    assert "[simulation]" in finding.mend
