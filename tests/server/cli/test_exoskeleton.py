"""`mirrorlimb exoskeleton`: nothing moves without a yes, and what is found out is written without spoiling the file."""

from __future__ import annotations

import os
import pty
import select
import signal
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from math import radians
from pathlib import Path

import msgspec
import numpy as np
import pytest
from typer.testing import CliRunner

from fusion.errors import InputError, MachineError
from server.cli.exoskeleton import exoskeleton
from server.cli.exoskeleton_edit import changed, edited
from server.cli.exoskeleton_mover import FASTEST_RAD_S, Mover
from server.cli.exoskeleton_wizard import Dialogue, corrected, walk
from server.emulated.rosbridge import RosbridgePeer
from server.exoskeleton import BUILT_IN, Exoskeleton, RosbridgeSettings
from server.exoskeleton_file import read_exoskeleton
from server.station.exo.driver import DriveCommand, DriveMode
from server.station.exo.rosbridge.drive import RosbridgeDrive
from server.station.exo.simulated import SimulatedDrive

EXAMPLES = Path(__file__).parents[3] / "examples" / "exoskeletons"
ONE_DEGREE = radians(1.0)


class Watched(SimulatedDrive):
    """Remembers what it was told."""

    def __init__(self, device: Exoskeleton) -> None:
        super().__init__(device)
        self.commands: list[DriveCommand] = []

    def command(self, command: DriveCommand, now_s: float) -> None:
        self.commands.append(command)
        super().command(command, now_s)


class Person:
    """Answers questions by what they contain; everything else with nothing."""

    def __init__(self, answers: dict[str, str]) -> None:
        self.asked: list[str] = []
        self.told: list[str] = []
        self._answers = answers

    def answer(self, question: str) -> str:
        self.asked.append(question)
        return next((answer for part, answer in self._answers.items() if part in question), "")

    @property
    def dialogue(self) -> Dialogue:
        return Dialogue(self.answer, self.told.append)


@pytest.fixture
def drive() -> Iterator[Watched]:
    with Watched(BUILT_IN) as drive:
        yield drive


@pytest.fixture
def mover(drive) -> Iterator[Mover]:
    with Mover(drive, BUILT_IN) as mover:
        yield mover


def _ticks(drive: Watched, count: int) -> None:
    """Wait until it has been commanded so often."""
    end_s = time.monotonic() + 5.0
    while len(drive.commands) < count:
        assert time.monotonic() < end_s
        time.sleep(0.005)


# ---------------------------------------------------------------- moving


def test_sr10_one_joint_moves_alone_slower_than_a_tenth_of_a_radian_a_second(drive, mover) -> None:
    before = [mover.joint_rad(i) for i in range(7)]
    mover.move(0, 2 * ONE_DEGREE)
    # The plane's joint alone: the axial rotation follows rotation less plane, so the rotation goes along.
    moved = [mover.joint_rad(i) - was for i, was in enumerate(before)]
    assert moved[0] == pytest.approx(2 * ONE_DEGREE, abs=0.01)
    assert moved[1:] == pytest.approx([0.0] * 6, abs=0.01)
    speeds = np.abs([command.velocity_rad_s for command in drive.commands])
    assert 0.02 < speeds.max() <= FASTEST_RAD_S + 1e-9
    assert drive.commands[-1].mode is DriveMode.HOLD


def test_sr10_nothing_moves_until_it_is_told_to(drive, mover) -> None:
    _ticks(drive, 10)
    assert {command.mode for command in drive.commands} == {DriveMode.HOLD}
    assert len({command.angle_rad for command in drive.commands}) == 1


def test_sr7_whatever_ends_a_movement_early_it_holds_there_at_once(drive, mover) -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, interrupt)
    signal.setitimer(signal.ITIMER_REAL, 0.3)
    with pytest.raises(KeyboardInterrupt):
        mover.move(3, 10 * ONE_DEGREE)
    signal.signal(signal.SIGALRM, before)
    time.sleep(0.05)
    held = drive.commands[-1]
    assert held.mode is DriveMode.HOLD
    assert 0 < held.angle_rad[3] - 1.0 < 5 * ONE_DEGREE
    time.sleep(0.1)
    assert drive.commands[-1].angle_rad == held.angle_rad


def test_sr8_a_fault_ends_a_movement_and_is_said() -> None:
    with RosbridgePeer(BUILT_IN) as peer:
        device = msgspec.structs.replace(BUILT_IN, drive="rosbridge", rosbridge=RosbridgeSettings(url=peer.url))
        with RosbridgeDrive(device) as drive, Mover(drive, device) as mover:
            mover.move(3, ONE_DEGREE)
            peer.obey("silent")
            with pytest.raises(MachineError, match="joint state is"):
                mover.move(3, 10 * ONE_DEGREE)


# ---------------------------------------------------------------- asking


def test_sr10_without_a_yes_no_joint_moves(drive, mover) -> None:
    for answer in ("", "n", "maybe", "yess", "ja"):
        assert walk(BUILT_IN, mover, ONE_DEGREE, Person({"Move": answer}).dialogue) == {}
        _ticks(drive, len(drive.commands) + 3)
    assert {command.mode for command in drive.commands} == {DriveMode.HOLD}


def test_a_joint_that_goes_the_right_way_needs_no_change(mover) -> None:
    person = Person({"Move 'elbow'": "y", "Did the arm bend": "y"})
    assert walk(BUILT_IN, mover, ONE_DEGREE, person.dialogue) == {}
    assert any("expected +1.0°" in said for said in person.told)


def test_a_joint_that_goes_the_wrong_way_gets_another_sign_and_the_offset_of_what_was_measured(mover) -> None:
    person = Person({"Move 'elbow' (": "y", "Did the arm bend": "n", "by a goniometer": "50"})
    changes = walk(BUILT_IN, mover, ONE_DEGREE, person.dialogue)
    assert changes == {3: {"sign": -1, "offset_rad": pytest.approx(1.0 + ONE_DEGREE + radians(50), abs=0.02)}}


def test_who_is_not_sure_changes_nothing(mover) -> None:
    person = Person({"Move 'elbow' (": "y", "Did the arm": "hm", "by a goniometer": "50"})
    assert walk(BUILT_IN, mover, ONE_DEGREE, person.dialogue) == {}
    assert not any("goniometer" in asked for asked in person.asked)


def test_near_its_end_a_joint_is_moved_the_other_way(mover) -> None:
    joints = [msgspec.structs.replace(j, max_rad=1.0 + ONE_DEGREE) if j.name == "elbow" else j for j in BUILT_IN.joints]
    person = Person({})
    walk(msgspec.structs.replace(BUILT_IN, joints=tuple(joints)), mover, 2 * ONE_DEGREE, person.dialogue)
    (asked,) = (question for question in person.asked if "'elbow'" in question)
    assert "by -2°, so that the arm will straighten" in asked


@pytest.mark.parametrize(
    ("reversed_", "truly", "expected"),
    [
        (False, None, {}),
        (False, 1.0, {}),
        (False, 0.4, {"offset_rad": 0.6}),
        (True, 0.0, {"sign": -1, "offset_rad": 1.0}),
        (True, -1.0, {"sign": -1}),
    ],
)
def test_what_the_file_should_say_gives_the_angle_that_was_measured(reversed_, truly, expected) -> None:
    elbow = BUILT_IN.joints[3]
    assert corrected(elbow, 1.0, reversed_, truly) == expected


# ---------------------------------------------------------------- writing


@pytest.mark.parametrize("example", sorted(EXAMPLES.glob("*.toml")), ids=lambda path: path.stem)
def test_what_is_written_is_read_back_and_every_comment_stays(example) -> None:
    device, text = read_exoskeleton(example), example.read_text("utf-8")
    changes = {1: {"sign": -device.joints[1].sign, "offset_rad": 0.25}, 3: {"offset_rad": -0.125}}
    after = edited(text, changes)
    assert _joints_of(after) == [
        {**joint, **{key: float(value) for key, value in changes.get(i, {}).items()}}
        for i, joint in enumerate(_joints_of(text))
    ]
    assert [line.partition("#")[2] for line in text.splitlines() if "#" in line] == [
        line.partition("#")[2] for line in after.splitlines() if "#" in line
    ]


def _joints_of(text: str) -> list[dict[str, object]]:
    return msgspec.toml.decode(text)["joints"]


@pytest.mark.parametrize(
    "text",
    [
        'joints = [{ name = "a", sign = 1 }, { name = "b", sign = 1 }]\n',
        '[[joints]]\nname = """\nsign = 3\n"""\nsign = 1\n[[joints]]\nname = "b"\n',
    ],
    ids=["inline", "in a text"],
)
def test_a_file_that_cannot_be_changed_safely_is_left_alone(text) -> None:
    assert edited(text, {0: {"sign": -1}}) is None


def test_a_changed_device_is_the_same_but_for_the_changes() -> None:
    after = changed(BUILT_IN, {3: {"sign": -1}})
    assert after.joints[3].sign == -1
    assert changed(after, {3: {"sign": 1}}) == BUILT_IN


# ---------------------------------------------------------------- the commands


@pytest.mark.parametrize("example", sorted(EXAMPLES.glob("*.toml")), ids=lambda path: path.stem)
def test_check_shows_every_joint_and_what_is_left_to_each_angle(example) -> None:
    shown = CliRunner().invoke(exoskeleton, ["check", str(example)], env={"COLUMNS": "140"})
    assert shown.exit_code == 0
    for joint in read_exoskeleton(example).joints:
        assert joint.name in shown.stdout
    for angle in ("plane", "elevation", "rotation", "elbow"):
        assert f"\n {angle} " in shown.stdout


def test_sr12_check_says_what_only_the_drive_can_tell(tmp_path) -> None:
    path = _mine(tmp_path, "cia402-four-joints.toml", "bitrate = 1_000_000", "bitrate = 50_000")
    ended = CliRunner().invoke(exoskeleton, ["check", str(path)])
    assert isinstance(ended.exception, InputError)
    assert "bitrate" in str(ended.exception)


def test_the_wizard_wants_somebody_to_ask() -> None:
    ended = CliRunner().invoke(exoskeleton, ["wizard", str(EXAMPLES / "simulated.toml")], input="y\n" * 20)
    assert isinstance(ended.exception, InputError)
    assert "a terminal" in str(ended.exception)


def _at_a_terminal(arguments: list[str], answer: Callable[[str], str | None]) -> tuple[int, str]:
    """Run the command at a real terminal; an answer of None is Ctrl-C."""
    code = "from server.cli.main import main; main()"
    child, terminal = pty.fork()
    if child == 0:
        os.execv(sys.executable, [sys.executable, "-u", "-c", code, *arguments])
    shown, question = "", ""
    end_s = time.monotonic() + 60
    with suppress(OSError):  # the terminal's other side has closed
        while select.select([terminal], [], [], max(end_s - time.monotonic(), 0))[0]:
            part = os.read(terminal, 4096).decode(errors="replace")
            shown, question = shown + part, question + part
            if question.rstrip().endswith("]"):
                said, question = answer(question), ""
                os.write(terminal, b"\x03" if said is None else f"{said}\n".encode())
    os.close(terminal)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), shown


def _mine(folder: Path, example: str, old: str, new: str) -> Path:
    path = folder / "mine.toml"
    path.write_text((EXAMPLES / example).read_text("utf-8").replace(old, new), "utf-8")
    return path


@pytest.mark.filterwarnings("ignore:.*forkpty.*:DeprecationWarning")  # the child becomes another program at once
def test_sr10_at_a_terminal_a_robot_is_tried_and_its_file_mended(tmp_path) -> None:
    with RosbridgePeer(read_exoskeleton(EXAMPLES / "rosbridge-seven-joints.toml")) as peer:
        path = _mine(tmp_path, "rosbridge-seven-joints.toml", "ws://127.0.0.1:9091", peer.url)
        stood = peer.robot.angle_rad.copy()
        answers = {"Is nobody": "y", "Move 'elbow_joint' (": "y", "Did the arm": "y", "goniometer": "45", "Write": "y"}
        code, shown = _at_a_terminal(
            ["exoskeleton", "wizard", str(path), "--by", "1"],
            lambda asked: next((answer for part, answer in answers.items() if part in asked), ""),
        )
        moved = peer.robot.angle_rad - stood
    assert code == 0, shown
    assert "Written." in shown
    assert np.degrees(moved) == pytest.approx([0, 0, 0, 1, 0, 0, 0], abs=0.05)
    elbow = read_exoskeleton(path).joints[3]
    assert elbow.sign * (stood[3] + moved[3] - elbow.offset_rad) == pytest.approx(radians(45), abs=0.002)


@pytest.mark.filterwarnings("ignore:.*forkpty.*:DeprecationWarning")  # the child becomes another program at once
def test_sr7_ctrl_c_at_a_question_ends_it_and_nothing_has_moved(tmp_path) -> None:
    with RosbridgePeer(read_exoskeleton(EXAMPLES / "rosbridge-seven-joints.toml")) as peer:
        path = _mine(tmp_path, "rosbridge-seven-joints.toml", "ws://127.0.0.1:9091", peer.url)
        stood = peer.robot.angle_rad.copy()
        code, shown = _at_a_terminal(
            ["exoskeleton", "wizard", str(path)], lambda asked: "y" if "Is nobody" in asked else None
        )
        assert peer.robot.angle_rad == pytest.approx(stood, abs=1e-3)
    assert code == 130
    assert "Traceback" not in shown
