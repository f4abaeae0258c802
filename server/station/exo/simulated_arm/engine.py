"""The border to MuJoCo: the scene stepped, and the drive's own belief asked; everything past here is plain arrays."""

from __future__ import annotations

from importlib import import_module
from math import cos, sin
from typing import Any, Final

import numpy as np
from scipy.spatial.transform import Rotation

from fusion.errors import MachineError
from fusion.kinematics.angles import pose_of
from fusion.messages import Floats
from server.exoskeleton import Exoskeleton
from server.station.exo.driver import Joints
from server.station.exo.simulated_arm.mechanics import LINKS
from server.station.exo.simulated_arm.mjcf import expected, scene
from server.station.exo.simulated_arm.person import HumanArm, Muscles

N: Final = len(LINKS)
LINK, ROTOR = slice(0, N), slice(N, 2 * N)
"""Of positions and velocities alike."""
SHOULDER_AT, ELBOW_AT = slice(2 * N, 2 * N + 4), 2 * N + 4
"""Of the positions; the shoulder is a quaternion."""
SHOULDER, ELBOW = slice(2 * N, 2 * N + 3), 2 * N + 3
"""Of the velocities."""


SETTLING: Final = 25
SETTLING_STEPS: Final = 10
"""The arm settles in so many rounds of so many steps, each from rest."""
ENGINE = "mujoco"


def _mujoco() -> Any:
    try:
        return import_module(ENGINE)
    except ImportError:
        raise MachineError(
            "MuJoCo, which the simulated exoskeleton is made with, is not installed",
            "the extra 'simulation'",
            ".venv/bin/python -m pip install -e '.[simulation]'",
        ) from None


class Scene:
    """Exoskeleton and arm, moved a millisecond at a time.

    Args:
        exoskeleton: its joints' limits are mechanical stops.
        arm: the human arm in it.
        muscles: of that arm.

    Raises:
        MachineError: MuJoCo is not installed.
    """

    def __init__(self, exoskeleton: Exoskeleton, arm: HumanArm, muscles: Muscles) -> None:
        mujoco = _mujoco()
        self._model = mujoco.MjModel.from_xml_string(scene(exoskeleton, arm))
        self._data = mujoco.MjData(self._model)
        self._step, self._forward = mujoco.mj_step, mujoco.mj_forward
        self._muscles = muscles
        self._turned = [self._data.body(name).xmat for name in ("upper arm", "forearm")]
        self._hand = self._data.body("hand")
        self._handle = self._data.body(f"link{N - 1}")
        self._hand_m = arm.segments[2].length_m
        self.motor_nm: Floats = self._data.ctrl[LINK]
        """(7,) torque of the motors, to be written into."""
        self.rotor_rad: Floats = self._data.qpos[ROTOR]
        """(7,) what the motors' encoders measure."""
        self.rotor_rad_s: Floats = self._data.qvel[ROTOR]
        self.link_rad: Floats = self._data.qpos[LINK]
        """(7,) where the links really are: the play and the wind-up of the gears lie between."""

    def place(self, joints_rad: Floats, angle_rad: Joints) -> None:
        """At rest with the joints at (7,), and an arm at the anatomical angles (4,) in it."""
        plane, elevation, rotation, elbow = angle_rad
        turned = Rotation.from_euler("YZY", [plane, elevation, rotation - plane])
        position = self._data.qpos
        position[LINK] = position[ROTOR] = joints_rad
        position[SHOULDER_AT] = turned.as_quat(scalar_first=True)
        position[ELBOW_AT] = elbow
        position[ELBOW_AT + 1 :] = 0.0
        self._data.qvel[:] = 0.0
        self._forward(self._model, self._data)

    def settle(self) -> None:
        """Let the arm sink into its cuffs while the motors stand still; nobody drops an arm in."""
        standing = self.rotor_rad.copy()
        for _ in range(SETTLING):
            self._step(self._model, self._data, nstep=SETTLING_STEPS)
            self._data.qvel[:] = 0.0
            self.rotor_rad[:] = standing

    def step(self, t_s: float) -> None:
        """Go on for `STEP_S` with the motors' torque; `t_s` is told to the muscles."""
        if not self._muscles.are_passive:
            self._act(t_s)
        self._step(self._model, self._data)

    def arm_rad(self) -> Joints:
        """(4,) the anatomical angles of the arm itself."""
        upper, forearm = (tuple(-turned[1::3]) for turned in self._turned)
        pose = pose_of(upper, forearm)
        return (pose.plane, pose.elevation, pose.twist, float(self._data.qpos[ELBOW_AT]))

    def hand_m(self) -> Floats:
        """(3,) the arm's third knuckle in limb coordinates, seen from where the shoulder's axes meet."""
        knuckle: Floats = self._hand.xpos - self._hand_m * self._hand.xmat[1::3]
        return knuckle

    def handle_m(self) -> Floats:
        """(3,) the shell's wrist, where the exoskeleton's last axes meet, as `hand_m`."""
        place: Floats = self._handle.xpos.copy()
        return place

    def _act(self, t_s: float) -> None:
        angles = self.arm_rad()
        about = self._muscles.torque_nm(t_s, angles, float(self._data.qvel[ELBOW]))
        turned = self._turned[0].reshape(3, 3)
        elevating = np.array([sin(angles[0]), 0.0, cos(angles[0])])
        shoulder = about[0] * np.array([0.0, 1.0, 0.0]) + about[1] * elevating + about[2] * turned[:, 1]
        self._data.qfrc_applied[SHOULDER] = turned.T @ shoulder
        self._data.qfrc_applied[ELBOW] = about[3]


class Belief:
    """What the drive believes of exoskeleton and arm: the torque that a movement takes.

    Args:
        exoskeleton: as it is.
        arm: the arm that it expects.

    Raises:
        MachineError: MuJoCo is not installed.
    """

    def __init__(self, exoskeleton: Exoskeleton, arm: HumanArm) -> None:
        mujoco = _mujoco()
        self._model = mujoco.MjModel.from_xml_string(expected(exoskeleton, arm))
        self._data = mujoco.MjData(self._model)
        self._inverse = mujoco.mj_inverse

    def torque_nm(self, joints_rad: Floats, velocity_rad_s: Floats, acceleration_rad_s2: Floats) -> Floats:
        """(7,) N m for this movement without friction."""
        data = self._data
        data.qpos[:], data.qvel[:], data.qacc[:] = joints_rad, velocity_rad_s, acceleration_rad_s2
        self._inverse(self._model, data)
        torque: Floats = data.qfrc_inverse.copy()
        return torque
