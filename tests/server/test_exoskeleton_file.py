"""The exoskeleton file: what the examples say is read, and what could not be moved safely is refused (SR-1, SR-12)."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from fusion.errors import InputError
from server.exoskeleton import BUILT_IN, FAMILIES, Cia402Settings, Exoskeleton, ExoskeletonJoint, RosbridgeSettings
from server.exoskeleton_file import read_exoskeleton

EXAMPLES = Path(__file__).parents[2] / "examples" / "exoskeletons"
SIMULATED, CIA402, ROSBRIDGE = "simulated.toml", "cia402-four-joints.toml", "rosbridge-seven-joints.toml"


def _changed(folder: Path, example: str, old: str, new: str) -> Path:
    text = (EXAMPLES / example).read_text("utf-8")
    assert old in text
    path = folder / "mine.toml"
    path.write_text(text.replace(old, new, 1), "utf-8")
    return path


def test_the_built_in_device_is_the_first_example() -> None:
    assert read_exoskeleton(EXAMPLES / SIMULATED) == BUILT_IN


@pytest.mark.parametrize("example", [SIMULATED, CIA402, ROSBRIDGE])
def test_every_example_is_read(example) -> None:
    assert read_exoskeleton(EXAMPLES / example).drive in example


@pytest.mark.parametrize(
    ("example", "forms"),
    [
        (SIMULATED, [Exoskeleton, ExoskeletonJoint]),
        (CIA402, [Exoskeleton, ExoskeletonJoint, Cia402Settings]),
        (ROSBRIDGE, [Exoskeleton, ExoskeletonJoint, RosbridgeSettings]),
    ],
)
def test_the_examples_explain_every_key_that_concerns_them(example, forms) -> None:
    text = (EXAMPLES / example).read_text("utf-8")
    elsewhere = {
        SIMULATED: {"node", "counts_per_turn", "cia402", "rosbridge"},
        CIA402: {"rest_rad", "rosbridge"},
        ROSBRIDGE: {"node", "counts_per_turn", "gear_ratio", "cia402"},
    }[example] | {"joints"}
    for key in {name for form in forms for name in form.__struct_fields__} - elsewhere:
        table = key in FAMILIES
        found = re.search(rf"^\[{key}\]" if table else rf"^{key} = .*#", text, re.MULTILINE)
        assert found or key in ("max_rad", "acceleration_rad_s2", "torque_nm", "channel"), key


WRONG = [
    # an unknown joint, angle, drive or key, with the nearest that there is
    (
        SIMULATED,
        'follows = "elbow"',
        'follows = "elbo"',
        ["joints[3].follows", "('elbow')", "axial_rotation", "'elbow'"],
    ),
    (SIMULATED, 'drive = "simulated"', 'drive = "simulatd"', ["'drive'", "simulatd", "cia402", "'simulated'"]),
    (SIMULATED, "gear_ratio = 100.0", "gear_ration = 100.0", ["'joints[0].gear_ration'", "Try: 'gear_ratio'"]),
    (CIA402, 'channel = "can0"', 'chanel = "can0"', ["'cia402.chanel'", "Try: 'channel'"]),
    (ROSBRIDGE, "state_topic", "state_topics", ["'rosbridge.state_topics'", "Try: 'state_topic'"]),
    (CIA402, "carry_nm = {}", "carry_nm = { elbo = 3.0 }", ["cia402.carry_nm", "'elbo'", "Try: 'elbow'"]),
    # what is missing
    (SIMULATED, "sign = 1 ", "", ["'joints[0].sign' is missing", "('shoulder plane')", "one of 1, -1"]),
    (SIMULATED, "min_rad = -0.7", "", ["'joints[0].min_rad' is missing"]),
    (SIMULATED, 'name = "simulated seven-joint arm"', "", ["'name' is missing"]),
    (SIMULATED, 'follows = "elbow"', 'follows = "none"', ["0 of 'joints'", '"elbow"']),
    (SIMULATED, 'follows = "axial_rotation"', 'follows = "none"', ["0 of 'joints'", '"axial_rotation"']),
    (CIA402, 'interface = "socketcan"', "", ["'cia402.interface' is missing", "socketcan"]),
    (CIA402, 'channel = "can0"', 'channel = ""', ["'cia402.channel' is missing"]),
    (CIA402, "\nnode = 1 ", "\n", ["joints[0].node is missing", "('shoulder plane')", "1 to 127"]),
    (ROSBRIDGE, 'url = "ws://127.0.0.1:9091"', "", ["'rosbridge.url' is missing", "ws://"]),
    # values that cannot be
    (SIMULATED, "sign = 1 ", "sign = 2 ", ["joints[0].sign", ": 2", "one of 1, -1"]),
    (SIMULATED, "sign = 1 ", "sign = 0 ", ["joints[0].sign", ": 0"]),
    (SIMULATED, "gear_ratio = 100.0", "gear_ratio = 0.0", ["joints[0].gear_ratio", "> 0"]),
    (SIMULATED, "gear_ratio = 100.0", "gear_ratio = -3", ["joints[0].gear_ratio", "> 0"]),
    (SIMULATED, "velocity_rad_s = 2.0", "velocity_rad_s = 0.0", ["joints[0].velocity_rad_s", "> 0"]),
    (SIMULATED, "acceleration_rad_s2 = 10.0", "acceleration_rad_s2 = 0", ["joints[0].acceleration_rad_s2", "> 0"]),
    (SIMULATED, "torque_nm = 40.0", "torque_nm = -1", ["joints[0].torque_nm", "> 0"]),
    (SIMULATED, "min_rad = -0.7", "min_rad = nan", ["joints[0].min_rad is nan", "('shoulder plane')", "finite"]),
    (SIMULATED, "max_rad = 2.3", "max_rad = inf", ["joints[0].max_rad is inf", "finite"]),
    (SIMULATED, "velocity_rad_s = 2.0", "velocity_rad_s = nan", ["joints[0].velocity_rad_s"]),
    (SIMULATED, "velocity_rad_s = 2.0", "velocity_rad_s = inf", ["joints[0].velocity_rad_s is inf", "finite"]),
    (SIMULATED, "offset_rad = 0.0", "offset_rad = nan", ["joints[0].offset_rad is nan"]),
    (SIMULATED, "min_rad = -0.7", 'min_rad = "-40°"', ["joints[0].min_rad", "`float`", "`str`"]),
    (SIMULATED, 'stop = "hold"', 'stop = "soft"', ["joints[0].stop", "one of hold, compliant"]),
    (SIMULATED, 'name = "elbow"', 'name = " "', ["joints[3].name", "a name"]),
    (CIA402, "heartbeat_s = 0.05", "heartbeat_s = inf", ["cia402.heartbeat_s is inf"]),
    (CIA402, "carry_nm = {}", "carry_nm = { elbow = nan }", ["cia402.carry_nm.elbow is nan"]),
    (CIA402, "\nnode = 1 ", "\nnode = 200 ", ["joints[0].node", "<= 127"]),
    (ROSBRIDGE, "ws://127.0.0.1:9091", "http://127.0.0.1:9091", ["'rosbridge.url' cannot be used", "ws://"]),
    (ROSBRIDGE, "ws://127.0.0.1:9091", "ws://127.0.0.1:909100", ["'rosbridge.url' cannot be used"]),
    (ROSBRIDGE, '"/joint_states"', '"joint_states"', ["rosbridge.state_topic", "/joint_states"]),
    (ROSBRIDGE, 'stop = "hold"', 'stop = "compliant"', ["joints[0].stop", "shoulder_plane_joint", "rosbridge cannot"]),
    (ROSBRIDGE, "lead_s = 0.02", "lead_s = 0.5", ["rosbridge.lead_s", "<= 0.1"]),
    # what does not go together
    (SIMULATED, "min_rad = -0.7", "min_rad = 2.4", ["joints[0].min_rad is not below max_rad", "2.4 and 2.3"]),
    (SIMULATED, 'name = "elbow"', 'name = "wrist flexion"', ["two of 'joints'", "'wrist flexion'"]),
    (SIMULATED, 'follows = "elevation"', 'follows = "plane"', ["2 of 'joints'", '"plane"']),
    (SIMULATED, 'follows = "elevation"', 'follows = "rotation"', ["0 of 'joints'", '"elevation"']),
    (SIMULATED, "rest_rad = 0.0", "rest_rad = 1.6", ["joints[4].rest_rad", "1.6", "-1.5708 to 1.5708"]),
    (SIMULATED, "velocity_rad_s = 4.0", "velocity_rad_s = 2.0", ["no movement for the rotation", "axial_rotation"]),
    (SIMULATED, "min_rad = -3.9", "min_rad = 0.0", ["no movement for the rotation"]),
    (
        SIMULATED,
        "offset_rad = 0.0",
        "offset_rad = 4.0",
        ["the plane", "-4.70 to -1.70", "mostly nothing that an arm can do"],
    ),
    (CIA402, "sign = -1", "sign = 1", ["the elevation", "-2.50 to 0.10", "offset_rad"]),
    (CIA402, "\nnode = 2", "\nnode = 1", ["joints[1].node is 1", "'shoulder plane' has already"]),
    (CIA402, "\nnode = 2", "\nnode = 127", ["joints[1].node is 127", "own_node"]),
]


@pytest.mark.parametrize(("example", "old", "new", "named"), WRONG, ids=[f"{w[1]} → {w[2]}" for w in WRONG])
def test_sr1_sr12_what_could_not_be_moved_safely_is_refused_by_file_and_key(tmp_path, example, old, new, named) -> None:
    path = _changed(tmp_path, example, old, new)
    with pytest.raises(InputError) as caught:
        read_exoskeleton(path)
    for part in (str(path), "Expected:", *named):
        assert part in str(caught.value)


def test_sr12_a_missing_file_is_named(tmp_path) -> None:
    with pytest.raises(InputError, match=r"nowhere\.toml' cannot be read: No such file"):
        read_exoskeleton(tmp_path / "nowhere.toml")


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("sign = 1 ", "", "'joints[0].sign' is missing"),
        ('follows = "elbow"', 'follows = "elbo"', "joints[3].follows"),
        ("min_rad = -0.7", "min_rad = 2.4", "joints[0].min_rad is not below max_rad"),
    ],
)
def test_sr12_the_service_does_not_start_with_it_and_says_why(tmp_path, old, new, named) -> None:
    _changed(tmp_path, SIMULATED, old, new)
    config = tmp_path / "config.toml"
    config.write_text('[station]\nexoskeleton = "mine.toml"\n', "utf-8")
    code = "from server.cli.main import main; main()"
    ended = subprocess.run(
        [sys.executable, "-c", code, "serve", "--config", config], capture_output=True, text=True, timeout=60
    )
    assert ended.returncode == 2
    assert "Traceback" not in ended.stderr
    assert ended.stdout == ""
    assert f"'{tmp_path / 'mine.toml'}'" in ended.stderr
    assert named in ended.stderr
