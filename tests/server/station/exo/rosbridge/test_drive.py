"""The drive against an emulated robot, over a real WebSocket in real time."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from math import cos, sin

import msgspec
import numpy as np
import pytest

from fusion.errors import MachineError
from server.emulated.rosbridge import RosbridgePeer
from server.exoskeleton import BUILT_IN, Exoskeleton, Follows, RosbridgeSettings
from server.messages import EXO_JOINTS, JointLimits
from server.station.exo.driver import ZERO, DriveCommand, DriveMode, DriveReading
from server.station.exo.drives import make_drive
from server.station.exo.rosbridge.drive import RosbridgeDrive

TURNED = msgspec.structs.replace(
    BUILT_IN,
    name="arm on ROS",
    drive="rosbridge",
    joints=tuple(
        joint
        if joint.follows is Follows.NONE
        else msgspec.structs.replace(joint, sign=-1, offset_rad=0.2, min_rad=-joint.max_rad, max_rad=-joint.min_rad + 1)
        for joint in BUILT_IN.joints
    ),
)


def _at(url: str) -> Exoskeleton:
    return msgspec.structs.replace(TURNED, rosbridge=RosbridgeSettings(url=url))


@pytest.fixture
def peer() -> Iterator[RosbridgePeer]:
    with RosbridgePeer(TURNED) as peer:
        yield peer


@pytest.fixture
def drive(peer: RosbridgePeer) -> Iterator[RosbridgeDrive]:
    with RosbridgeDrive(_at(peer.url)) as drive:
        yield drive


def _until(drive: RosbridgeDrive, good: Callable[[DriveReading], bool], within_s: float = 5.0) -> DriveReading:
    """Hold where it was first measured until the reading is good."""
    end_s, here = time.monotonic() + within_s, drive.read(time.monotonic()).angle_rad
    while time.monotonic() < end_s:
        now_s = time.monotonic()
        drive.command(DriveCommand(DriveMode.HOLD, here, ZERO, "test"), now_s)
        reading = drive.read(now_s)
        if good(reading):
            return reading
        time.sleep(0.01)
    pytest.fail(f"not within {within_s} s: {drive.read(time.monotonic())}")


def _wave(drive: RosbridgeDrive, ticks: int) -> float:
    """Follow a smooth movement, a step a tick however long that takes; the worst distance."""
    here, worst = drive.read(time.monotonic()).angle_rad, 0.0
    for tick in range(ticks):
        t_s = tick * 0.01
        wanted = tuple(angle + 0.2 * (1 - cos(2 * t_s)) for angle in here)
        drive.command(DriveCommand(DriveMode.FOLLOW, wanted, (0.4 * sin(2 * t_s),) * 4, ""), time.monotonic())
        time.sleep(0.01)
        measured = drive.read(time.monotonic()).angle_rad
        worst = max(worst, *(abs(a - b) for a, b in zip(measured, wanted, strict=True)))
    return worst


def test_a_smooth_command_is_followed_in_every_anatomical_angle(peer, drive) -> None:
    assert _wave(drive, 100) < 0.1
    assert peer.trajectories > 20
    assert not peer.refusals
    _until(drive, lambda reading: not reading.fault)


def test_what_is_said_is_rosbridges_own_protocol(peer) -> None:
    with RosbridgeDrive(_at(peer.url)):
        pass
    settings = TURNED.rosbridge
    end_s = time.monotonic() + 5.0
    while len(peer.operations) < 3 and time.monotonic() < end_s:
        time.sleep(0.01)
    assert peer.operations == [
        f"advertise {settings.trajectory_topic}",
        f"subscribe {settings.state_topic}",
        f"unadvertise {settings.trajectory_topic}",
    ]


def test_sr3_a_robot_that_hears_nothing_more_brakes_and_holds(peer, drive) -> None:
    here = drive.read(time.monotonic()).angle_rad
    for tick in range(50):
        wanted = tuple(angle + 0.008 * tick for angle in here)
        drive.command(DriveCommand(DriveMode.FOLLOW, wanted, (0.8,) * 4, ""), time.monotonic())
        time.sleep(0.01)
    time.sleep(0.6)
    rest = drive.read(time.monotonic())
    assert max(map(abs, rest.velocity_rad_s)) < 0.02
    # Led by 20 ms, braked at 10 rad/s² at least, and a tick or two of way.
    assert all(a - b < 0.8 * 0.1 + 0.8**2 / 20 for a, b in zip(rest.angle_rad, wanted, strict=True))
    time.sleep(0.2)
    assert drive.read(time.monotonic()).angle_rad == pytest.approx(rest.angle_rad, abs=0.005)


@pytest.mark.parametrize(
    ("typed", "said"),
    [("silent", "s old"), ("frozen", "s old"), ("lag 0.3", "s old"), ("drop", "was lost")],
)
def test_sr8_a_robot_that_fails_is_a_fault_in_words_and_well_again_when_it_is(peer, drive, typed, said) -> None:
    _until(drive, lambda reading: not reading.fault)
    peer.obey(typed)
    assert said in _until(drive, lambda reading: bool(reading.fault)).fault
    time.sleep(0.05)  # what was under way arrives
    followed = peer.trajectories
    for _ in range(20):
        drive.command(DriveCommand(DriveMode.HOLD, drive.read(time.monotonic()).angle_rad, ZERO, ""), time.monotonic())
        time.sleep(0.005)
    assert typed == "drop" or peer.trajectories == followed  # who cannot be seen is not commanded, and has braked
    peer.obey("well")
    _until(drive, lambda reading: not reading.fault)


@pytest.mark.parametrize("typed", ["deaf", "lie elbow 0.5"])
def test_sr8_a_robot_that_does_not_go_where_it_is_told_is_a_fault(peer, drive, typed) -> None:
    _until(drive, lambda reading: not reading.fault)
    here = drive.read(time.monotonic()).angle_rad
    peer.obey(typed)
    end_s = time.monotonic() + 10.0
    far = tuple(angle + 0.5 for angle in here) if typed == "deaf" else here
    while "does not follow" not in (fault := drive.read(time.monotonic()).fault) and time.monotonic() < end_s:
        drive.command(DriveCommand(DriveMode.FOLLOW, far, ZERO, ""), time.monotonic())
        time.sleep(0.01)
    assert "does not follow" in fault


def test_sr6_after_a_broken_link_nothing_is_sent_until_the_robot_is_where_it_is_told(peer, drive) -> None:
    _until(drive, lambda reading: not reading.fault)
    here = drive.read(time.monotonic()).angle_rad
    peer.drop()
    _until(drive, lambda reading: bool(reading.fault))
    followed = peer.trajectories
    elsewhere = DriveCommand(DriveMode.HOLD, tuple(angle + 0.3 for angle in here), ZERO, "fault")
    end_s = time.monotonic() + 5.0
    while drive.read(time.monotonic()).fault and time.monotonic() < end_s:
        drive.command(elsewhere, time.monotonic())
        time.sleep(0.01)
    for _ in range(20):
        drive.command(elsewhere, time.monotonic())
        time.sleep(0.01)
    assert peer.trajectories == followed
    _until(drive, lambda _: peer.trajectories > followed)


def test_sr1_a_trajectory_stays_inside_what_the_patient_may_do(peer, drive) -> None:
    here = drive.read(time.monotonic()).angle_rad
    drive.fit(
        tuple(
            JointLimits(joint=name, min_rad=a - 0.05, max_rad=a + 0.05, velocity_rad_s=1.0, acceleration_rad_s2=5.0)
            for name, a in zip(EXO_JOINTS, here, strict=True)
        )
    )
    expected = pytest.approx([0.05] * 3, abs=0.005)
    for _ in range(5):  # a machine that is busy keeps even this from it now and then
        moved = _pushed(drive, here)
        if moved == expected:
            break
    assert moved == expected


def _pushed(drive: RosbridgeDrive, here: tuple[float, ...]) -> list[float]:
    """Command it far beyond its range; how far plane, elevation and elbow went.

    The rotation is left out: the axial joint's range follows from plane and rotation together.
    """
    _until(drive, lambda reading: not reading.fault)
    for _ in range(40):
        far = DriveCommand(DriveMode.FOLLOW, tuple(angle + 0.3 for angle in here), (0.5,) * 4, "")
        drive.command(far, time.monotonic())
        time.sleep(0.01)
    reached = drive.read(time.monotonic()).angle_rad
    return [reached[i] - here[i] for i in (0, 1, 3)]


def test_a_command_never_waits_for_a_peer_that_does_not_read(peer, drive) -> None:
    _until(drive, lambda reading: not reading.fault)
    here = drive.read(time.monotonic()).angle_rad
    peer.stall(2.0)
    time.sleep(0.02)
    followed = peer.trajectories
    for _ in range(500):
        drive.command(DriveCommand(DriveMode.HOLD, here, ZERO, ""), time.monotonic())
    assert peer.trajectories == followed  # every one was given before the peer went on


def test_sr6_a_robot_that_stands_a_little_elsewhere_is_brought_there_slowly(peer, drive) -> None:
    here = drive.read(time.monotonic()).angle_rad
    beside, fastest = tuple(angle + 0.08 for angle in here), 0.0
    for _ in range(150):
        drive.command(DriveCommand(DriveMode.HOLD, beside, ZERO, ""), time.monotonic())
        time.sleep(0.01)
        fastest = max(fastest, *np.abs(peer.robot.velocity_rad_s))
    assert 0.05 < fastest < 0.3
    _until(drive, lambda reading: not reading.fault)
    assert drive.read(time.monotonic()).angle_rad[3] > here[3] + 0.05


# ---------------------------------------------------------------- refused at the start


def test_sr12_nobody_there_is_said_with_the_url() -> None:
    with RosbridgePeer(TURNED) as gone:
        url = gone.url
    with pytest.raises(MachineError, match=rf"No rosbridge server answers at '{url}' \(Connection refused\)"):
        make_drive(_at(url)).__enter__()


def test_sr12_a_joint_that_the_robot_does_not_have_is_named_with_those_it_has(peer) -> None:
    other = msgspec.structs.replace(TURNED.joints[3], name="elbow_joint")
    wrong = msgspec.structs.replace(_at(peer.url), joints=(*TURNED.joints[:3], other, *TURNED.joints[4:]))
    with pytest.raises(MachineError, match=r"no joint 'elbow_joint'; it has .*elbow.*Expected.*JointState"):
        RosbridgeDrive(wrong).__enter__()


def test_sr12_a_topic_on_which_nothing_comes_is_named(peer) -> None:
    silent = msgspec.structs.replace(TURNED, rosbridge=RosbridgeSettings(url=peer.url, state_topic="/nothing"))
    with pytest.raises(MachineError, match="Nothing came on '/nothing'"):
        RosbridgeDrive(silent).__enter__()


def test_sr10_a_resting_joint_that_stands_elsewhere_is_not_moved_but_named(peer) -> None:
    peer.obey("lie wrist flexion 0.5")
    with pytest.raises(MachineError, match=r"'wrist flexion' follows nothing and stands at 0\.50 rad"):
        RosbridgeDrive(_at(peer.url)).__enter__()


def test_what_the_robots_side_refuses_is_a_fault_in_its_words(peer, drive) -> None:
    peer.obey("complain type mismatch on the topic")
    assert "type mismatch" in _until(drive, lambda reading: bool(reading.fault)).fault
    drive.reset()
    _until(drive, lambda reading: not reading.fault)
