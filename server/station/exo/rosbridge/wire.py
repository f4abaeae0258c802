"""What is said over rosbridge: JSON objects with an `op`, and the two ROS 2 messages in them.

rosbridge v2 protocol: github.com/RobotWebTools/rosbridge_suite, ROSBRIDGE_PROTOCOL.md.
"""

from __future__ import annotations

import msgspec

TRAJECTORY_TYPE = "trajectory_msgs/msg/JointTrajectory"
STATE_TYPE = "sensor_msgs/msg/JointState"
LONGEST_MESSAGE_BYTES = 65_536
_UNREADABLE = (msgspec.MsgspecError, UnicodeDecodeError, RecursionError)


class Time(msgspec.Struct, frozen=True):
    """builtin_interfaces/Time and /Duration."""

    sec: int = 0
    nanosec: int = 0

    @property
    def seconds(self) -> float:
        """As one number."""
        return self.sec + self.nanosec * 1e-9


class Header(msgspec.Struct, frozen=True):
    """std_msgs/Header. A stamp of zero says "now" to a trajectory controller; without one rosbridge sets its own."""

    stamp: Time = Time()
    frame_id: str = ""


class Point(msgspec.Struct, frozen=True):
    """trajectory_msgs/JointTrajectoryPoint."""

    positions: tuple[float, ...]
    velocities: tuple[float, ...]
    time_from_start: Time


class JointTrajectory(msgspec.Struct, frozen=True):
    """trajectory_msgs/JointTrajectory."""

    joint_names: tuple[str, ...]
    points: tuple[Point, ...]
    header: Header = Header()


class JointState(msgspec.Struct, frozen=True):
    """sensor_msgs/JointState; rosbridge writes what is not a number as null. Any list but `name` may be empty."""

    name: tuple[str, ...]
    position: tuple[float | None, ...] = ()
    velocity: tuple[float | None, ...] = ()
    effort: tuple[float | None, ...] = ()
    header: Header = Header()


class Heard(msgspec.Struct, frozen=True):
    """What rosbridge says to us: a "publish" of a topic, or a "status"."""

    op: str
    topic: str = ""
    level: str = ""
    msg: msgspec.Raw = msgspec.Raw(b"null")


def advertise(topic: str) -> bytes:
    """We shall publish trajectories there."""
    return msgspec.json.encode({"op": "advertise", "topic": topic, "type": TRAJECTORY_TYPE})


def unadvertise(topic: str) -> bytes:
    """We publish no more."""
    return msgspec.json.encode({"op": "unadvertise", "topic": topic})


def subscribe(topic: str) -> bytes:
    """Joint states, each as it comes: not throttled, the newest only, in plain JSON."""
    return msgspec.json.encode(
        {
            "op": "subscribe",
            "topic": topic,
            "type": STATE_TYPE,
            "throttle_rate": 0,
            "queue_length": 1,
            "compression": "none",
        }
    )


def publish(topic: str, trajectory: JointTrajectory) -> bytes:
    """One trajectory."""
    return msgspec.json.encode({"op": "publish", "topic": topic, "msg": trajectory})


def heard(message: str | bytes) -> Heard | None:
    """What was said; None where it is nothing of rosbridge's."""
    try:
        return msgspec.json.decode(message, type=Heard)
    except _UNREADABLE:
        return None


def joint_state(raw: msgspec.Raw) -> JointState | None:
    """The joint state in a message; None where it is none."""
    try:
        return msgspec.json.decode(raw, type=JointState)
    except _UNREADABLE:
        return None


def time_of(seconds: float) -> Time:
    """Seconds as ROS says them."""
    whole = round(seconds * 1e9)
    return Time(whole // 1_000_000_000, whole % 1_000_000_000)
