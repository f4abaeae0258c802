"""The robot behind the emulated rosbridge: joints with inertia and limits under a joint trajectory controller.

The controller is as strict as ROS 2's joint_trajectory_controller with its defaults (all joints named, times growing,
at rest at the end) and interpolates from where it wanted to be (`interpolate_from_desired_state`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from fusion.messages import Floats
from server.exoskeleton import Exoskeleton, Follows
from server.station.exo.joint_map import JointMap

REST_RAD = (0.9, 0.4, 0.2, 1.0)
"""The anatomical angles at which it stands when it is switched on."""
NATURAL_RAD_S = 40.0
"""Of the position servos; the damping ratio is 1."""
SUBSTEP_S = 0.002
LONGEST_CATCH_UP_S = 0.5


@dataclass(frozen=True, slots=True)
class Path:
    """A trajectory that was accepted, from where the controller wanted to be; every array starts with that."""

    t_s: Floats  # (k,)
    angle_rad: Floats  # (k, n)
    velocity_rad_s: Floats  # (k, n)

    def at(self, t_s: float) -> tuple[Floats, Floats]:
        """Wanted angles and velocities (n,): cubics between the points, at rest after the last."""
        if t_s >= self.t_s[-1]:
            return self.angle_rad[-1], np.zeros_like(self.angle_rad[-1])
        i = max(int(np.searchsorted(self.t_s, t_s, side="right")) - 1, 0)
        length = self.t_s[i + 1] - self.t_s[i]
        u = max(t_s - self.t_s[i], 0.0) / length
        a, b, p, q = self.angle_rad[i], self.angle_rad[i + 1], self.velocity_rad_s[i], self.velocity_rad_s[i + 1]
        angle = a + u * (length * p + u * (3 * (b - a) - length * (2 * p + q) + u * (2 * (a - b) + length * (p + q))))
        slope = (6 * u * (1 - u) * (b - a)) / length + p * (1 - u) * (1 - 3 * u) + q * u * (3 * u - 2)
        return angle, slope


class EmulatedRobot:
    """One robot.

    Args:
        exoskeleton: its joints; their ranges are mechanical stops, their speeds its motors' own limits.
    """

    def __init__(self, exoskeleton: Exoskeleton) -> None:
        joints = exoskeleton.joints
        self.names = tuple(joint.name for joint in joints)
        self._ends = np.array([(joint.min_rad, joint.max_rad) for joint in joints]).T  # (2, n)
        self._fastest = np.array([joint.velocity_rad_s for joint in joints])  # (n,)
        self._strongest = 3.0 * np.array([joint.acceleration_rad_s2 for joint in joints])  # (n,) what motors can do
        rest = np.array([joint.rest_rad for joint in joints])
        resting = np.array([joint.follows is Follows.NONE for joint in joints])
        self.angle_rad: Floats = np.clip(
            np.where(resting, rest, JointMap(exoskeleton).joints_rad(REST_RAD)), *self._ends
        )
        self.velocity_rad_s: Floats = np.zeros(len(joints))
        self.acceleration_rad_s2: Floats = np.zeros(len(joints))
        self._path = Path(np.zeros(1), self.angle_rad[None].copy(), np.zeros((1, len(joints))))
        self._t_s: float | None = None

    def follow(self, names: tuple[str, ...], t_s: ArrayLike, angles: ArrayLike, speeds: ArrayLike, now_s: float) -> str:
        """Take a trajectory; what is wrong with it otherwise, and it is not followed.

        Args:
            names: of the joints (n,), in any order.
            t_s: time of each point from now (k,).
            angles: (k, n) rad.
            speeds: (k, n) rad/s.
            now_s: now.
        """
        times, wanted, moving = np.asarray(t_s, float), np.asarray(angles, float), np.asarray(speeds, float)
        self.step(now_s)  # until now it followed what it was told before
        refusal = self._refusal(names, times, wanted, moving)
        if refusal:
            return refusal
        order = [names.index(name) for name in self.names]
        from_rad, from_rad_s = self._path.at(now_s)
        self._path = Path(
            np.concatenate(([now_s], now_s + times)),
            np.vstack((from_rad, wanted[:, order])),
            np.vstack((from_rad_s, moving[:, order])),
        )
        return ""

    def step(self, now_s: float) -> None:
        """Live on until now."""
        start_s = now_s if self._t_s is None else max(self._t_s, now_s - LONGEST_CATCH_UP_S)
        steps = int((now_s - start_s) / SUBSTEP_S + 1e-6)
        for i in range(steps):
            self._substep(start_s + (i + 1) * SUBSTEP_S)
        self._t_s = start_s + steps * SUBSTEP_S

    def _substep(self, t_s: float) -> None:
        wanted, moving = self._path.at(t_s)
        pull = NATURAL_RAD_S**2 * (wanted - self.angle_rad) + 2 * NATURAL_RAD_S * (moving - self.velocity_rad_s)
        before = self.velocity_rad_s
        pull = np.clip(pull, -self._strongest, self._strongest)
        velocity = np.clip(before + pull * SUBSTEP_S, -self._fastest, self._fastest)
        angle = np.clip(self.angle_rad + velocity * SUBSTEP_S, *self._ends)
        self.velocity_rad_s = (angle - self.angle_rad) / SUBSTEP_S
        self.acceleration_rad_s2 = (self.velocity_rad_s - before) / SUBSTEP_S
        self.angle_rad = angle

    def _refusal(self, names: tuple[str, ...], times: Floats, angles: Floats, speeds: Floats) -> str:
        if sorted(names) != sorted(self.names):
            return "joint_names are not those of the controller"
        shape = (len(times), len(names))
        if not len(times) or angles.shape != shape or speeds.shape != shape:
            return "points without a position and a velocity for each joint"
        if not (np.isfinite(angles).all() and np.isfinite(speeds).all()):
            return "points that are no numbers"
        if times[0] < 0 or (np.diff(times) <= 0).any():
            return "time_from_start does not grow"
        return "velocity at the end is not zero" if speeds[-1].any() else ""
