"""An exoskeleton behind ROS 2: joint trajectories out, joint states in, through rosbridge (docs/rosbridge.md).

Every command carries its own end: a robot that hears nothing more brakes and holds (SR-3). What this way cannot do is
said there too: no softness, no torque bound, no limits written into the robot.
"""

from __future__ import annotations

import threading
import time
from contextlib import ExitStack
from types import TracebackType
from typing import Self

import numpy as np

from fusion.errors import MachineError
from fusion.messages import Floats
from server.exoskeleton import Exoskeleton, Follows
from server.messages import JointLimits
from server.station.exo.driver import ZERO, DriveCommand, DriveMode, DriveReading
from server.station.exo.joint_map import JointMap
from server.station.exo.rosbridge import wire
from server.station.exo.rosbridge.following import Following
from server.station.exo.rosbridge.link import Link
from server.station.exo.rosbridge.states import JointStates
from server.station.exo.rosbridge.trajectory import trajectory

STATE_WITHIN_S = 2.0
STALE_S = 0.1
"""A measurement older than this is a fault."""
AT_REST_RAD = 0.2
"""A joint that follows nothing may stand so far from its `rest_rad`."""
SHOWN_LETTERS = 200


class RosbridgeDrive:
    """A drive over rosbridge.

    Args:
        exoskeleton: its joints' names are the robot's; `rosbridge` says where it is.
    """

    name = "rosbridge"
    can_comply = False

    def __init__(self, exoskeleton: Exoskeleton) -> None:
        settings, joints = exoskeleton.rosbridge, exoskeleton.joints
        self._exoskeleton, self._settings, self._map = exoskeleton, settings, JointMap(exoskeleton)
        self._braking = np.array([joint.acceleration_rad_s2 for joint in joints])  # (n,)
        self._range = self._ends = np.array([(joint.min_rad, joint.max_rad) for joint in joints])  # (n, 2)
        self._rests = np.array([joint.follows is Follows.NONE for joint in joints])  # (n,)
        self._rest = np.array([joint.rest_rad for joint in joints])  # (n,) where those that rest stand
        self._states, self._complete = JointStates(), threading.Event()
        self._following = Following()
        self._last = ZERO
        self._said = ""
        self._link = Link(
            settings.url,
            (wire.advertise(settings.trajectory_topic), wire.subscribe(settings.state_topic)),
            wire.unadvertise(settings.trajectory_topic),
            self._hear,
            self._forget,
        )

    def __enter__(self) -> Self:
        with ExitStack() as stack:
            stack.enter_context(self._link)
            self._await_states()
            self._require_rest()
            stack.pop_all()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        # Nothing more is sent: the last trajectory ends at rest, and the robot holds there.
        self._link.__exit__(kind, error, trace)

    def fit(self, limits: tuple[JointLimits, ...]) -> None:
        """No trajectory leaves what these limits leave of the joints' own ranges."""
        fitted = self._map.ranges_rad(tuple((joint.min_rad, joint.max_rad) for joint in limits))
        inside = np.column_stack((np.maximum(self._range, fitted)[:, 0], np.minimum(self._range, fitted)[:, 1]))
        self._ends = np.where(self._rests[:, None], self._range, inside)

    def reset(self) -> None:
        """What the robot's side said is answered; other faults end with their causes."""
        self._said = ""

    def command(self, command: DriveCommand, now_s: float) -> None:
        """Send the command's trajectory to a robot that is seen, and seen where it is told to be; others brake."""
        states = self._states
        measured = self._measured(states)
        if measured is None or self._age_s(states, now_s) > STALE_S:
            self._following = Following()
            return
        if not self._following.joined:
            self._rest = measured  # joints that follow nothing are held where they stand: nothing moves unasked
        joints = np.where(self._rests, self._rest, self._map.joints_rad(command.angle_rad))
        self._following = self._following.step(
            self._map.names, joints, measured, command.mode is DriveMode.FOLLOW, self._settings.following_rad, now_s
        )
        if self._following.joined:
            speeds = self._map.joints_rad_s(command.velocity_rad_s)
            self._send(joints + self._following.gap_rad, speeds + self._following.closing_rad_s)

    def read(self, now_s: float) -> DriveReading:
        """The newest joint states."""
        states = self._states
        angles = self._measured(states)
        if angles is None:
            return DriveReading(now_s, self._last, ZERO, ZERO, self._link.trouble or "No joint state came yet.")
        joints = [states.joints[name] for name in self._map.names]
        age_s = self._age_s(states, now_s)
        stale = f"The newest joint state is {age_s:.2f} s old." if age_s > STALE_S else ""
        self._last = self._map.anatomical_rad(angles)
        return DriveReading(
            now_s - age_s,
            self._last,
            self._map.anatomical_rad_s([joint.velocity_rad_s for joint in joints]),
            self._map.anatomical_nm([joint.torque_nm for joint in joints]),
            self._link.trouble or self._said or stale or self._following.fault,
        )

    def _measured(self, states: JointStates) -> Floats | None:
        """The joints' angles (n,), None until every one has been heard of."""
        if states.missing(self._map.names):
            return None
        return np.array([states.joints[name].angle_rad for name in self._map.names])

    def _age_s(self, states: JointStates, now_s: float) -> float:
        """Of the oldest joint."""
        return now_s - min(states.joints[name].t_s for name in self._map.names)

    def _send(self, joints: Floats, velocities: Floats) -> None:
        made = trajectory(self._map.names, joints, velocities, self._braking, self._ends, self._settings.lead_s)
        self._link.give(wire.publish(self._settings.trajectory_topic, made))

    # ---------------------------------------------------------------- opening

    def _await_states(self) -> None:
        if self._complete.wait(STATE_WITHIN_S):
            return
        place = f"'{self._settings.state_topic}' at '{self._settings.url}'"
        missing = self._states.missing(self._map.names)[0]
        heard = ", ".join(self._states.joints)
        silent = f"Nothing came on {place} within {STATE_WITHIN_S:g} s {self._said}".rstrip()
        raise MachineError(
            f"{place} has no joint '{missing}'; it has {heard}" if heard else silent,
            f"{wire.STATE_TYPE} with every joint of '{self._exoskeleton.name}'",
            "mend the joints' names or 'rosbridge.state_topic' in the exoskeleton file (`ros2 topic echo` shows both)",
        )

    def _require_rest(self) -> None:
        for joint in self._exoskeleton.joints:
            stands = self._states.joints[joint.name].angle_rad
            if joint.follows is Follows.NONE and abs(stands - joint.rest_rad) > AT_REST_RAD:
                raise MachineError(
                    f"'{joint.name}' follows nothing and stands at {stands:.2f} rad; its rest_rad is {joint.rest_rad}",
                    f"at most {AT_REST_RAD:g} rad between them",
                    "bring it there with the robot's own tools, or mend 'rest_rad' in the exoskeleton file",
                )

    # ---------------------------------------------------------------- in the link's thread

    def _hear(self, message: str | bytes) -> None:
        heard = wire.heard(message)
        if heard is None:
            return
        if heard.op == "status" and heard.level == "error":
            self._said = (
                f"The robot's side refused something: {bytes(heard.msg).decode(errors='replace')[:SHOWN_LETTERS]}"
            )
        state = wire.joint_state(heard.msg) if heard.topic == self._settings.state_topic else None
        if state is not None:
            self._states = self._states.heard(state, time.monotonic())
            if not self._states.missing(self._map.names):
                self._complete.set()

    def _forget(self) -> None:
        """When the link is back, the robot may be elsewhere and its clock another."""
        self._states, self._following, self._said = JointStates(), Following(), ""
