"""The configuration: what is written is read, and what is wrong is named."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest

from fusion.errors import InputError
from server.config import Config, StationStart, read_config, read_start, write_start
from server.exoskeleton import BUILT_IN
from server.messages import EXO_JOINTS


def _file(folder: Path, text: str) -> Path:
    path = folder / "mirrorlimb.toml"
    path.write_text(text)
    return path


def test_an_empty_file_gives_the_documented_defaults(tmp_path: Path) -> None:
    config = read_config(_file(tmp_path, ""))
    assert config == Config()
    assert config.station.sensors.ports["kinectv2-osc"] == 12345
    assert tuple(limits.joint for limits in config.station.device) == EXO_JOINTS


def test_nested_values_are_read(tmp_path: Path) -> None:
    config = read_config(_file(tmp_path, 'port = 8123\n[station.sensors]\nbind = "192.168.7.1"\n'))
    assert (config.port, config.station.sensors.bind) == (8123, "192.168.7.1")


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("prot = 1", ["'prot'", "port"]),
        ("[station.sensors]\nbnd = '127.0.0.1'", ["'station.sensors.bnd'", "allowed_senders"]),
        ("[station]\ndrive = 'simulated'", ["'station.drive'", "exoskeleton"]),
        ("[station]\nrate_hz = 'fast'", ["'station.rate_hz'", "int"]),
        ("[station.gate]\nblend_s = 0.5", ["'station.gate.blend_s'", ">= 2"]),
        ("[station.gate]\nhold_from_rad = 0.3", ["station.gate.slow_from_rad", "hold_from_rad"]),
        ("[station.gate]\nslow_from_s = 0.1", ["station.gate.slow_from_s", "stale_s"]),
        ("[station.gate]\nheartbeat_s = inf", ["station.gate.heartbeat_s", "not finite"]),
        ("[station.gate]\nengage_within_rad = nan", ["station.gate.engage_within_rad"]),
        ("port = 70000", ["'port'", "65535"]),
        ("[station]\nexoskeleton = 7", ["station.exoskeleton", "path"]),
        ("port = ", ["not well-formed", "TOML"]),
    ],
)
def test_a_bad_key_or_value_is_named_with_what_was_expected(tmp_path: Path, text: str, named: list[str]) -> None:
    path = _file(tmp_path, text)
    with pytest.raises(InputError) as caught:
        read_config(path)
    for part in [str(path), *named]:
        assert part in str(caught.value)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"nowhere\.toml"):
        read_config(tmp_path / "nowhere.toml")


def test_an_exoskeleton_file_is_read_beside_the_configuration(tmp_path: Path) -> None:
    named = msgspec.structs.replace(BUILT_IN, name="mine")
    (tmp_path / "mine.json").write_bytes(msgspec.json.encode(named))
    config = read_config(_file(tmp_path, "[station]\nexoskeleton = 'mine.json'"))
    assert config.station.exoskeleton == named


def test_sr2_drives_that_expect_another_rate_than_the_stations_are_refused(tmp_path: Path) -> None:
    example = Path(__file__).parents[3] / "examples" / "exoskeletons" / "cia402-four-joints.toml"
    file = _file(tmp_path, f"[station]\nexoskeleton = '{example}'\nrate_hz = 50")
    with pytest.raises(InputError, match=r"period_s = 0\.02"):
        read_config(file)


def test_limits_without_room_are_refused(tmp_path: Path) -> None:
    narrow = msgspec.structs.replace(BUILT_IN.joints[0], max_rad=-1.0)
    station = msgspec.structs.replace(
        Config().station, exoskeleton=msgspec.structs.replace(BUILT_IN, joints=(narrow, *BUILT_IN.joints[1:]))
    )
    path = tmp_path / "start.json"
    write_start(StationStart(data="d", channels="c", station=station), path)
    with pytest.raises(InputError, match="'shoulder plane'"):
        read_start(path)


def test_the_start_file_comes_back_as_it_was_written(tmp_path: Path) -> None:
    start = StationStart(data="/data", channels="/run/x", demo=True)
    path = tmp_path / "start.json"
    write_start(start, path)
    assert read_start(path) == start
    assert path.stat().st_mode & 0o077 == 0
