"""The virtual patient: sits or stands, sways, and reaches with the healthy arm like a person; seeded and stepped."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.spatial.transform import Rotation

from fusion.messages import Floats, TrunkFrame
from fusion.skeleton import INDEX, Side
from fusion.virtual_patient.anatomy import (
    UP,
    Anatomy,
    ArmPose,
    Posture,
    legs_from_pelvis,
    pelvis_height_m,
    resting,
    trunk_and_arms,
)
from fusion.virtual_patient.movement import Movement
from fusion.virtual_patient.reaching import clipped, pose_for_hand
from fusion.virtual_patient.stroll import Stroll
from fusion.virtual_patient.sway import Sway


@dataclass(frozen=True, slots=True)
class HandGoal:
    """Bring the healthy hand to a place in the trunk frame (m; origin between the shoulders)."""

    hand_in_trunk: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class PoseGoal:
    """Bring the healthy arm to joint angles."""

    pose: ArmPose


ReachGoal = HandGoal | PoseGoal

_REACTION_S: Final = (0.22, 0.05)
"""Mean and standard deviation of the time from a new goal to the first movement."""
_AIM_ERROR: Final = 0.06
"""Standard deviation of a first movement's error as a share of its way; a second one mends it."""
_MENDED_RAD: Final = 0.01
_LEAN_RAD_PER_RAD: Final = 0.08
"""How far the trunk leans with the arm's elevation: little when able, much when not (compensation)."""
_ARMS: Final = {
    side: [INDEX[f"{name}{side.suffix}"] for name in ("Shoulder", "Elbow", "Wrist", "Hand", "HandTip", "Thumb")]
    for side in Side
}
_SWAY_RAD: Final = np.array([0.020, 0.025, 0.012])
"""Standard deviation of the trunk's pitch, yaw and roll."""


class VirtualPatient:
    """A person with one healthy arm.

    The world's y is up and its floor y = 0; the patient sits above the origin and faces −z, so the world's axes are the
    trunk's: x to the patient's right, z from chest to back.

    Args:
        healthy_side: the arm that reaches.
        seed: of everything random; equal seeds and steps give equal motion.
        ability: (0, 1]; lower is slower and leans more.
        posture: sitting or standing.
        anatomy: lengths.
        stroll_m: how far the whole body shifts about its place (one standard deviation per axis); 0 = it does not.
    """

    def __init__(
        self,
        healthy_side: Side,
        seed: int,
        *,
        ability: float = 1.0,
        posture: Posture = Posture.SITTING,
        anatomy: Anatomy | None = None,
        stroll_m: float = 0.0,
    ) -> None:
        self.healthy_side, self.posture = healthy_side, posture
        self.anatomy = anatomy or Anatomy()
        self.t_s = 0.0
        self.lean_rad = 0.0
        """Leaning ahead beyond what reaching brings with it; to be changed at any time, as `hitch_m`."""
        self.hitch_m = 0.0
        """How far the healthy shoulder is drawn up."""
        self._ability = ability
        self._rng = np.random.default_rng(seed)
        self._sway = Sway(_SWAY_RAD, self._rng)
        self._stroll = Stroll(stroll_m, seed)
        self._legs = legs_from_pelvis(self.anatomy, posture)
        self._rest = resting(posture)
        self._movement = Movement(self._rest.as_array())
        self._goal: ReachGoal | None = None
        self._wanted_rad = self._rest.as_array()
        self._reacts_at_s = float("inf")

    @property
    def healthy_pose(self) -> ArmPose:
        """The healthy arm's angles now."""
        return ArmPose(*self._movement.pose_rad(self.t_s).tolist())

    @property
    def trunk(self) -> TrunkFrame:
        """The trunk in the world now."""
        rotation = self._trunk_rotation()
        pelvis = pelvis_height_m(self.anatomy, self.posture) * UP + self._stroll.at(self.t_s)
        return TrunkFrame(pelvis + self.anatomy.spine_m * (rotation @ UP), rotation)

    def step(self, dt_s: float, goal: ReachGoal | None = None, affected: ArmPose | None = None) -> Floats:
        """Live on for `dt_s`.

        Args:
            dt_s: seconds.
            goal: where the healthy arm should go; None = rest.
            affected: where the exoskeleton holds the affected arm; None = it lies or hangs.

        Returns:
            (25, 3) m in the world.
        """
        self.t_s += dt_s
        self._sway.step(dt_s)
        self._take(goal)
        self._act()
        arms = {self.healthy_side: self.healthy_pose, self.healthy_side.other: affected or self._rest}
        trunk = self.trunk
        in_trunk = trunk_and_arms(self.anatomy, arms)
        in_trunk[_ARMS[self.healthy_side]] += self.hitch_m * UP
        positions: Floats = trunk.origin_in_room + in_trunk @ trunk.rotation_trunk_to_room.T
        for joint, place in self._legs.items():
            positions[joint] = positions[INDEX["SpineBase"]] + place
        return positions

    def _take(self, goal: ReachGoal | None) -> None:
        """Notice a new goal; the arm starts after the reaction time."""
        if goal == self._goal:
            return
        self._goal = goal
        self._reacts_at_s = self.t_s + max(0.1, float(self._rng.normal(*_REACTION_S)))

    def _act(self) -> None:
        if self.t_s >= self._reacts_at_s:
            self._reacts_at_s = float("inf")
            self._wanted_rad = self._pose_for(self._goal).as_array()
            way = self._wanted_rad - self._movement.end_rad()
            missed = way * self._rng.normal(0.0, _AIM_ERROR, 4)
            self._movement = self._movement.towards(self._wanted_rad + missed, self.t_s, self._ability)
        elif self._movement.is_over(self.t_s) and self._is_off():
            self._movement = self._movement.towards(self._wanted_rad, self.t_s, self._ability)

    def _is_off(self) -> bool:
        return float(np.abs(self._wanted_rad - self._movement.end_rad()).max()) > _MENDED_RAD

    def _pose_for(self, goal: ReachGoal | None) -> ArmPose:
        if goal is None:
            return self._rest
        if isinstance(goal, PoseGoal):
            return clipped(goal.pose)
        outward = np.array([1.0 if self.healthy_side is Side.RIGHT else -1.0, 1.0, 1.0])
        from_shoulder = np.array(goal.hand_in_trunk) * outward - [self.anatomy.shoulder_width_m / 2, self.hitch_m, 0.0]
        return pose_for_hand(from_shoulder, self.anatomy.arm, self.healthy_pose)

    def _trunk_rotation(self) -> Floats:
        """(3, 3) trunk to world: sway, and leaning ahead (pitch about −x) with the arm."""
        pitch, yaw, roll = self._sway.angles_rad
        lean = self.lean_rad + _LEAN_RAD_PER_RAD / self._ability * self.healthy_pose.elevation_rad
        return np.asarray(Rotation.from_euler("YXZ", [yaw, pitch - lean, roll]).as_matrix())
