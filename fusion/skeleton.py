"""The 25 joints of a Kinect v2 skeleton, its bones and its two sides."""

from __future__ import annotations

from enum import StrEnum
from typing import Final

import numpy as np

JOINTS: Final[tuple[str, ...]] = (
    "SpineBase",
    "SpineMid",
    "Neck",
    "Head",
    "ShoulderLeft",
    "ElbowLeft",
    "WristLeft",
    "HandLeft",
    "ShoulderRight",
    "ElbowRight",
    "WristRight",
    "HandRight",
    "HipLeft",
    "KneeLeft",
    "AnkleLeft",
    "FootLeft",
    "HipRight",
    "KneeRight",
    "AnkleRight",
    "FootRight",
    "SpineShoulder",
    "HandTipLeft",
    "ThumbLeft",
    "HandTipRight",
    "ThumbRight",
)
"""Joint names in Kinect v2 order; the index of a joint is its place here."""

JOINT_COUNT: Final = len(JOINTS)
INDEX: Final[dict[str, int]] = {name: i for i, name in enumerate(JOINTS)}

BONES: Final[tuple[tuple[str, str], ...]] = (
    ("SpineBase", "SpineMid"),
    ("SpineMid", "SpineShoulder"),
    ("SpineShoulder", "Neck"),
    ("Neck", "Head"),
    *(
        pair
        for side in ("Left", "Right")
        for pair in (
            ("SpineShoulder", f"Shoulder{side}"),
            (f"Shoulder{side}", f"Elbow{side}"),
            (f"Elbow{side}", f"Wrist{side}"),
            (f"Wrist{side}", f"Hand{side}"),
            (f"Hand{side}", f"HandTip{side}"),
            (f"Wrist{side}", f"Thumb{side}"),
            ("SpineBase", f"Hip{side}"),
            (f"Hip{side}", f"Knee{side}"),
            (f"Knee{side}", f"Ankle{side}"),
            (f"Ankle{side}", f"Foot{side}"),
        )
    ),
)
"""Parent and child of every bone."""

BONE_INDICES: Final = np.array([(INDEX[a], INDEX[b]) for a, b in BONES])  # (24, 2)


class Side(StrEnum):
    """A side of the patient's body, always the patient's own left or right."""

    LEFT = "left"
    RIGHT = "right"

    @property
    def other(self) -> Side:
        """The opposite side."""
        return Side.RIGHT if self is Side.LEFT else Side.LEFT

    @property
    def suffix(self) -> str:
        """The side as joint names spell it: ``Left`` or ``Right``."""
        return self.value.capitalize()


class TrackingState:
    """How well a sensor says it sees a joint (Kinect SDK 2.0 `TrackingState`)."""

    LOST: Final = 0
    INFERRED: Final = 1
    TRACKED: Final = 2


def arm(side: Side) -> tuple[int, int, int, int]:
    """Indices of shoulder, elbow, wrist and hand of one side."""
    shoulder, elbow, wrist, hand = (INDEX[f"{name}{side.suffix}"] for name in ("Shoulder", "Elbow", "Wrist", "Hand"))
    return shoulder, elbow, wrist, hand


def _swapped() -> np.ndarray:
    order = list(range(JOINT_COUNT))
    for name, i in INDEX.items():
        if name.endswith("Left"):
            order[i] = INDEX[name.replace("Left", "Right")]
        elif name.endswith("Right"):
            order[i] = INDEX[name.replace("Right", "Left")]
    return np.array(order)


SIDES_SWAPPED: Final = _swapped()
"""(25,) ``positions[SIDES_SWAPPED]`` is the same skeleton with left and right exchanged."""
