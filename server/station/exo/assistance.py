"""How much of the movement is the drive's: all of it, as much as is needed, or none.

Assist-as-needed. With e the joint's distance from its set-point, e₀ the variability that everybody has, the need h
obeys

    dh/dt = (min(max(|e| − e₀, 0) / e₁, 1) − h) / τ,   share of stiffness = h, from `LEAST` to the therapist's level

so help grows with the error and is forgotten while the patient tracks well: the discrete h ← f h + g e of
[Emken2007] with forgetting f = 1 − dt/τ and gain g = dt/(τ e₁), and its weighting function that disregards ordinary
variability as the dead zone e₀. The drive is an impedance about the set-point with that share of its stiffness and a
bounded torque, as compliant as the need allows [Wolbrecht2008], who add the forgetting because people let a machine
work that never lessens its help; the kinds of controller are reviewed in [Marchal-Crespo2009]. What is not done:
[Wolbrecht2008] also learn where in the workspace the patient is weak (docs/decisions/assist-as-needed.md).

[Emken2007] J. NeuroEng. Rehabil. 4:8, doi 10.1186/1743-0003-4-8
[Wolbrecht2008] IEEE Trans. Neural Syst. Rehabil. Eng. 16(3) 286-297, doi 10.1109/TNSRE.2008.918389
[Marchal-Crespo2009] J. NeuroEng. Rehabil. 6:20, doi 10.1186/1743-0003-6-20
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from server.messages import Assistance
from server.station.exo.driver import JOINT_COUNT, ONE, ZERO, Joints
from server.station.exo.softness import SOFT_SHARE

FORGET_S = 2.0
"""τ."""
USUAL_RAD = 0.05
"""e₀."""
FULL_RAD = 0.25
"""e₁: an error so far beyond the usual one that lasts comes to need all the help."""
LEAST = 0.02
"""Share below which help does not fade: enough to notice where the movement goes."""
BLEND_S = 1.0
"""From no help to all of it, and back, takes at least so long."""
FIRM_S = 0.25
"""From no stiffness to all of it where the arm is brought to rest."""


@dataclass(frozen=True, slots=True)
class Help:
    """The way of helping, and how much help there is now."""

    mode: Assistance = Assistance.PASSIVE
    level: float = 1.0
    """0..1: the most help that `Assistance.ASSISTED` gives."""
    needed: Joints = ONE
    """h."""
    share: Joints = ONE
    """0..1 of the drive's stiffness per joint, but for the walls."""


def refused(mode: Assistance, level: float, can_comply: bool) -> str:
    """Why this way of helping cannot be, as a sentence; "" = it can."""
    if not 0.0 <= level <= 1.0:
        return "The level of help must lie between 0 and 1."
    if mode is not Assistance.PASSIVE and not can_comply:
        return "This exoskeleton cannot yield; it can only move the arm as the healthy one moves."
    return ""


def chosen(before: Help, mode: Assistance, level: float) -> Help:
    """Another way of helping. A patient who begins to be assisted begins with all the help that is allowed."""
    if mode is before.mode:
        return replace(before, level=level)
    return replace(before, mode=mode, level=level, needed=(level,) * JOINT_COUNT)


def helped(before: Help, error_rad: Joints, dt_s: float) -> Help:
    """The help one tick later, while the arm is led.

    Args:
        before: the help so far.
        error_rad: measured less set-point, per joint.
        dt_s: length of the tick.
    """
    if before.mode is not Assistance.ASSISTED:
        goal = ZERO if before.mode is Assistance.FREE else ONE
        return replace(before, share=_blended(before.share, goal, dt_s / BLEND_S))
    needed = tuple(map(lambda h, e: _needed(h, e, dt_s), before.needed, error_rad))
    goal = tuple(min(max(h, LEAST), before.level) for h in needed)
    return replace(before, needed=needed, share=_blended(before.share, goal, dt_s / BLEND_S))


def _needed(so_far: float, error_rad: float, dt_s: float) -> float:
    wanted = min(max(abs(error_rad) - USUAL_RAD, 0.0) / FULL_RAD, 1.0)
    return so_far + (wanted - so_far) * dt_s / FORGET_S


def at_rest(before: Help, soft: tuple[bool, ...], dt_s: float) -> Help:
    """The help one tick later, while the arm is brought to rest or held: soft at once, firm quickly."""
    given = tuple(min(share, SOFT_SHARE) if gives else share for share, gives in zip(before.share, soft, strict=True))
    goal = tuple(SOFT_SHARE if gives else 1.0 for gives in soft)
    return replace(before, share=_blended(given, goal, dt_s / FIRM_S))


def _blended(before: Joints, goal: Joints, most: float) -> Joints:
    return tuple(b + min(max(g - b, -most), most) for b, g in zip(before, goal, strict=True))
