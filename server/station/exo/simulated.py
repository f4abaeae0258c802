"""The simulated exoskeleton: seven geared joints that carry a human arm, and the regulator of a good position drive.

What it is made of and where each number comes from: docs/simulated-arm.md.
"""

from __future__ import annotations

from math import isfinite
from types import TracebackType
from typing import Final, Self

from fusion.errors import InputError
from server.exoskeleton import Exoskeleton
from server.messages import JointLimits
from server.station.exo.driver import DriveCommand, DriveReading, Joints
from server.station.exo.joint_map import JointMap
from server.station.exo.simulated_arm.engine import Belief, Scene
from server.station.exo.simulated_arm.mechanics import CHAIN, is_such_an_arm
from server.station.exo.simulated_arm.mjcf import STEP_S
from server.station.exo.simulated_arm.person import Effort, HumanArm, Muscles, Spasticity
from server.station.exo.simulated_arm.regulator import Regulator

LONGEST_CATCH_UP_S: Final = 0.5
"""A simulation that was not asked for longer skips ahead; nothing in it moves on its own by then."""
KNOWN_LOAD: Final = 0.9
"""Share of the arm's mass that the drive believes in: people are not all alike."""
AT_REST: Final[Joints] = (0.9, 0.4, 0.2, 1.0)
"""Where a seated patient's arm lies in it."""


class SimulatedDrive:
    """A drive of equal standing with a real one: it is commanded, measured and watched in the same way.

    It measures what a real one does, at the motors: the gears' play and wind-up and the cuffs' softness stay unseen.

    Args:
        exoskeleton: the chain of joints of `simulated_arm.mechanics.CHAIN`; their ends are mechanical stops.
        arm: the arm that is put in.
        effort: what its muscles do; None = nothing.
        spasticity: of its elbow; None = it is calm.

    Raises:
        InputError: the exoskeleton's joints are not those of the simulated arm.
        MachineError: MuJoCo is not installed.
    """

    name = "simulated"
    can_comply = True

    def __init__(
        self,
        exoskeleton: Exoskeleton,
        arm: HumanArm | None = None,
        effort: Effort | None = None,
        spasticity: Spasticity | None = None,
    ) -> None:
        if not is_such_an_arm(exoskeleton):
            raise InputError(
                f"the exoskeleton '{exoskeleton.name}' is not the simulated arm",
                f"joints that follow {', '.join(CHAIN)}, in this order",
                "mend the joints' 'follows', or name another 'drive'",
            )
        arm = arm or HumanArm()
        self._map = JointMap(exoskeleton)
        self.scene = Scene(exoskeleton, arm, Muscles(effort, spasticity, STEP_S))
        """What is really so; a controller must not look, a test or an experiment may."""
        self._regulator = Regulator(exoskeleton, self._map, Belief(exoskeleton, arm.believed(KNOWN_LOAD)))
        self._now_s: float | None = None
        self._fault = ""
        self._put_in(AT_REST)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._regulator.hold(self.scene.rotor_rad)

    def fit(self, limits: tuple[JointLimits, ...]) -> None:
        """Somebody puts the arm in, at rest as a seated patient's lies, and at least a tenth inside its range."""
        inside = []
        for angle, joint in zip(AT_REST, limits, strict=True):
            inset = 0.1 * (joint.max_rad - joint.min_rad)
            inside.append(min(max(angle, joint.min_rad + inset), joint.max_rad - inset))
        self._put_in(tuple(inside))

    def reset(self) -> None:
        """Its faults end with their causes; there is nothing to leave."""

    def command(self, command: DriveCommand, now_s: float) -> None:
        """Take over a command; one that is not all numbers is a fault, and counts as one that did not come."""
        self._advance(now_s)
        if all(map(isfinite, (*command.angle_rad, *command.velocity_rad_s, *command.share))):
            self._regulator.take(command, now_s)
            self._fault = ""
        else:
            self._fault = "The drive was given a command that is not a number."

    def read(self, now_s: float) -> DriveReading:
        """Live on up to now and measure."""
        self._advance(now_s)
        scene, to = self.scene, self._map
        return DriveReading(
            t_s=now_s,
            angle_rad=to.anatomical_rad(scene.rotor_rad),
            velocity_rad_s=to.anatomical_rad_s(scene.rotor_rad_s),
            torque_nm=to.anatomical_nm(scene.motor_nm),
            fault=self._fault,
            interaction_nm=to.anatomical_nm(self._regulator.interaction_nm(scene)),
        )

    def _put_in(self, angle_rad: Joints) -> None:
        joints = self._map.joints_rad(angle_rad)
        self.scene.place(joints, angle_rad)
        self.scene.settle()
        self._regulator.begin(joints)

    def _advance(self, now_s: float) -> None:
        start_s = now_s if self._now_s is None else max(self._now_s, now_s - LONGEST_CATCH_UP_S)
        for step in range(1, int((now_s - start_s) / STEP_S + 1e-6) + 1):
            self._now_s = start_s + step * STEP_S
            self.scene.motor_nm[:] = self._regulator.torque_nm(self._now_s, self.scene)
            self.scene.step(self._now_s)
        if self._now_s is None or self._now_s < now_s - STEP_S:
            self._now_s = now_s
