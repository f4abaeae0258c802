"""Which bones an inertial sensor turns with, by the site that recordings name."""

from __future__ import annotations

from typing import Final

from fusion.skeleton import INDEX, Side

Bone = tuple[int, int]
"""Parent and child joint."""


def _bone(parent: str, child: str) -> Bone:
    return INDEX[parent], INDEX[child]


def _of_arm(side: Side) -> dict[str, tuple[Bone, ...]]:
    s = side.suffix
    return {
        f"upper-arm-{side.value}": (_bone(f"Shoulder{s}", f"Elbow{s}"),),
        f"forearm-{side.value}": (_bone(f"Elbow{s}", f"Wrist{s}"),),
        f"hand-{side.value}": (_bone(f"Wrist{s}", f"Hand{s}"),),
    }


BONES_AT: Final[dict[str, tuple[Bone, ...]]] = {
    "upper-back": (
        _bone("SpineBase", "SpineShoulder"),
        _bone("SpineShoulder", "ShoulderLeft"),
        _bone("SpineShoulder", "ShoulderRight"),
    ),
    **_of_arm(Side.LEFT),
    **_of_arm(Side.RIGHT),
}
"""Trunk and shoulder girdle turn as one; collar bones and spine give a little (`GIVE_M`)."""
GIVE_M: Final[dict[str, float]] = {site: 0.03 if site == "upper-back" else 0.01 for site in BONES_AT}
"""How far the far end of a bone may move against its segment without the sensor's turning."""
