"""Orders to running drives, and what their journal tells."""

from __future__ import annotations

from pathlib import Path

import can
import msgspec
import pytest

from fusion.errors import InputError, MachineError
from server.emulated.cia402.control import Control, Journal, obey, order
from server.emulated.cia402.serve import Emulator, open_bus
from server.exoskeleton import BUILT_IN, Cia402Settings, Exoskeleton


def _two_joints() -> Exoskeleton:
    joints = tuple(msgspec.structs.replace(joint, node=i + 1) for i, joint in enumerate(BUILT_IN.joints))
    return msgspec.structs.replace(BUILT_IN, joints=joints)


@pytest.fixture
def emulator() -> Emulator:
    with can.Bus(interface="virtual", channel="control") as bus:
        return Emulator(_two_joints(), bus)


@pytest.mark.parametrize(
    ("line", "attribute", "value"),
    [
        ("silent elbow", "silent", True),
        ("silent elbow 0", "silent", False),
        ("lie elbow -0.25", "lie_rad", -0.25),
        ("lag elbow 0.2", "lag_s", 0.2),
        ("false-limits elbow", "false_limits", True),
    ],
)
def test_an_order_is_done_to_the_joint_that_it_names(
    emulator: Emulator, line: str, attribute: str, value: object
) -> None:
    assert obey(line, emulator.nodes) == ""
    assert getattr(emulator.nodes["elbow"].wrong, attribute) == value
    assert getattr(emulator.nodes["shoulder plane"].wrong, attribute) != value or not value


def test_a_joint_whose_name_has_spaces_and_a_number_in_hexadecimal_are_understood(emulator: Emulator) -> None:
    assert obey("fault shoulder plane 0x7121", emulator.nodes) == ""
    assert emulator.nodes["shoulder plane"].drive.state.value == "fault"


def test_all_means_every_joint(emulator: Emulator) -> None:
    obey("silent all", emulator.nodes)
    assert all(node.wrong.silent for node in emulator.nodes.values())


@pytest.mark.parametrize("line", ["", "break elbow", "silent knee", "silent", "lie elbow a lot"])
def test_what_is_no_order_is_refused_with_the_orders(emulator: Emulator, line: str) -> None:
    said = obey(line, emulator.nodes)
    assert "fault" in said
    assert "elbow" in said


def test_orders_come_from_other_processes_by_a_socket(emulator: Emulator, tmp_path: Path) -> None:
    with Control(tmp_path / "orders") as control:
        order(tmp_path / "orders", "lag elbow 0.1")
        order(tmp_path / "orders", "silent elbow")
        control.obey_all(emulator.nodes)
    wrong = emulator.nodes["elbow"].wrong
    assert (wrong.lag_s, wrong.silent) == (0.1, True)
    assert not (tmp_path / "orders").exists()


def test_the_journal_tells_every_joints_true_place(emulator: Emulator, tmp_path: Path) -> None:
    with Journal(tmp_path / "journal.csv") as journal:
        journal.note(emulator.nodes, 1.0)
        journal.note(emulator.nodes, 1.001)
        journal.note(emulator.nodes, 1.01)
    lines = (tmp_path / "journal.csv").read_text().splitlines()
    assert len(lines) == 1 + 2 * len(emulator.nodes)
    assert "1.0000,elbow,1.00000,0.0000,switch on disabled" in lines


@pytest.mark.parametrize(
    ("settings", "error", "said"),
    [
        (Cia402Settings(interface="nonsense", channel="can0"), MachineError, "nonsense can0"),
        (Cia402Settings(interface="socketcand", options={"host": "192.0.2.1", "port": 1}), InputError, "this machine"),
    ],
)
def test_a_bus_that_cannot_be_emulated_is_named(settings: Cia402Settings, error: type[Exception], said: str) -> None:
    with pytest.raises(error, match=said):
        open_bus(settings)
