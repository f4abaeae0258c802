"""What a patient's affected arm may do: how far, with how much torque, with how much help; and who signed for it."""

from __future__ import annotations

from math import pi, radians
from typing import Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

AssistanceName = Literal["passive", "assisted", "free"]
"""The drive moves the arm; it helps as much as is needed; it only carries the arm's weight."""


class _Value(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class JointRange(_Value):
    """How far one joint may be moved, in radians."""

    min_rad: float = Field(ge=-pi, le=pi)
    max_rad: float = Field(ge=-pi, le=pi)

    @model_validator(mode="after")
    def _is_in_order(self) -> Self:
        if self.min_rad >= self.max_rad:
            raise ValueError("the least angle must be smaller than the greatest")
        return self


def _degrees(least: float, greatest: float) -> JointRange:
    return JointRange(min_rad=radians(least), max_rad=radians(greatest))


class PassiveRange(_Value):
    """How far a therapist could move each joint of the affected arm by hand, measured at enrolment (SR-18).

    Plane (0 = sideways, +90° = ahead) and elevation of the upper arm's swing, the humerus' rotation (internal +), elbow
    flexion. The defaults are cautious: within what a relaxed adult arm allows.
    """

    plane: JointRange = _degrees(-20, 120)
    elevation: JointRange = _degrees(0, 100)
    rotation: JointRange = _degrees(-60, 80)
    elbow: JointRange = _degrees(0, 135)


class JointForce(_Value):
    """With how much torque one joint may be moved, in newton metres."""

    torque_nm: float = Field(default=15.0, gt=0, le=60, description="The most beyond carrying the arm (SR-2).")
    resistance_nm: float = Field(
        default=6.0, gt=0, le=60, description="Where the arm resists with more, a soft hold at once (SR-18)."
    )


class ForceLimits(_Value):
    """With how much torque each joint of the affected arm may be moved. The defaults are cautious."""

    plane: JointForce = JointForce()
    elevation: JointForce = JointForce()
    rotation: JointForce = JointForce()
    elbow: JointForce = JointForce()


class PatientLimits(_Value):
    """Everything that a person signs for."""

    passive_range: PassiveRange = PassiveRange()
    force_limits: ForceLimits = ForceLimits()
    assist_level_most: float = Field(default=1.0, ge=0, le=1)

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {
                    "passive_range": PassiveRange().model_dump(),
                    "force_limits": ForceLimits().model_dump(),
                    "assist_level_most": 0.8,
                }
            ]
        }
    )
