"""One arm from tick to tick: trunk, segment lengths, angles with bounds, and the mirrored target."""

from __future__ import annotations

from dataclasses import dataclass

from fusion.kinematics.angles import arm_angles
from fusion.kinematics.body_frame import trunk_frame
from fusion.kinematics.lengths import LengthLearner
from fusion.kinematics.mirror import mirror
from fusion.kinematics.witnesses import Witnesses
from fusion.messages import AlignedSample, ArmLengths, FusedFrame, JointAngles, MirrorTarget, TrunkFrame
from fusion.skeleton import Side


@dataclass(frozen=True, slots=True)
class Followed:
    """What can be said of the arm at one instant; parts are None until they can be known."""

    trunk: TrunkFrame | None
    lengths: ArmLengths | None
    healthy: JointAngles | None
    target: MirrorTarget | None


class ArmFollower:
    """Follows the healthy arm and mirrors it; what it learns of one patient ends with it."""

    def __init__(self, side: Side) -> None:
        self._side = side
        self._lengths = LengthLearner()
        self._witnesses = Witnesses()
        self._target: MirrorTarget | None = None

    def follow(self, fused: FusedFrame | None, samples: tuple[AlignedSample, ...]) -> Followed:
        """One tick.

        Args:
            fused: the body; None where it is not told.
            samples: the latest of every sensor, which `fused` is told from.
        """
        trunk = trunk_frame(fused.positions_in_room) if fused else None
        healthy = self._angles(fused, trunk, samples) if fused else None
        self._target = mirror(healthy, self._target) if healthy else None
        return Followed(trunk, self._lengths.lengths, healthy, self._target)

    def _angles(
        self, fused: FusedFrame, trunk: TrunkFrame | None, samples: tuple[AlignedSample, ...]
    ) -> JointAngles | None:
        """The arm's angles, once its lengths are known."""
        self._lengths.update(fused, self._side)
        lengths = self._lengths.lengths
        if trunk is None or lengths is None:
            return None
        witnessed = self._witnesses.hear(fused, trunk, self._side, samples)
        return arm_angles(fused, trunk, self._side, lengths, witnessed)
