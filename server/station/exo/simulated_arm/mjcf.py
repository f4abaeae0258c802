"""The scene as MuJoCo reads it (MJCF), in limb coordinates: x outward, y up, z back; the shoulder's axes meet at 0."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

from server.exoskeleton import Exoskeleton, ExoskeletonJoint
from server.station.exo.simulated_arm.mechanics import GEARS, LINKS, Gear, Link
from server.station.exo.simulated_arm.person import (
    CUFF_DAMPING_S,
    FOREARM_CUFF,
    HANDLE,
    UPPER_CUFF,
    Cuff,
    HumanArm,
    Segment,
)

STEP_S: Final = 0.001
GRAVITY_M_S2: Final = 9.81
CUFFS: Final = (UPPER_CUFF, FOREARM_CUFF, HANDLE)
HELD: Final = (2, 4, 6)
"""The links whose shells hold upper arm, forearm and hand."""
_STOP: Final = 'solreflimit="0.005 1"'
"""A mechanical stop gives way for some 5 ms (MuJoCo's time constant of a limit)."""
ELBOW_RANGE_RAD: Final = (-0.1, 2.7)


def scene(exoskeleton: Exoskeleton, arm: HumanArm) -> str:
    """The exoskeleton with motors, gears and their play, and the arm in its cuffs.

    Coordinates in this order: seven links, seven rotors, the arm's shoulder (a quaternion), elbow, forearm, wrist.
    """
    sites = dict(zip(HELD, (_site(f"shell{k}", cuff) for k, cuff in enumerate(CUFFS)), strict=True))
    links = _shells(exoskeleton, sites, limited=True)
    rotors = "".join(_rotor(k, joint, gear) for k, (joint, gear) in enumerate(_geared(exoskeleton)))
    gears = "".join(_gear(k, gear) for k, gear in enumerate(GEARS))
    motors = "".join(f'<motor joint="rotor{k}"/>' for k in range(len(GEARS)))
    cuffs = "".join(_cuff(k, cuff) for k, cuff in enumerate(CUFFS))
    return _mujoco(links + rotors + _human(arm), f"<tendon>{gears}</tendon><actuator>{motors}{cuffs}</actuator>")


def expected(exoskeleton: Exoskeleton, arm: HumanArm) -> str:
    """What a drive believes: rigid links without play or friction, and the arm's masses fixed to their shells."""
    masses = dict(zip(HELD, map(_fixed, arm.segments), strict=True))
    return _mujoco(_shells(exoskeleton, masses, limited=False), "")


def _mujoco(bodies: str, rest: str) -> str:
    return (
        f'<mujoco><compiler angle="radian" autolimits="true"/><option timestep="{STEP_S}" integrator="implicitfast"'
        f' gravity="0 {-GRAVITY_M_S2} 0"><flag contact="disable"/></option>'
        f"<worldbody>{bodies}</worldbody>{rest}</mujoco>"
    )


def _geared(exoskeleton: Exoskeleton) -> Iterable[tuple[ExoskeletonJoint, Gear]]:
    return zip(exoskeleton.joints, GEARS, strict=True)


def _shells(exoskeleton: Exoskeleton, inside: dict[int, str], limited: bool) -> str:
    """The links, each in the one before; the coordinate of a joint is the angle that the exoskeleton file speaks of."""
    text = ""
    for k, (link, (joint, gear)) in enumerate(zip(LINKS, _geared(exoskeleton), strict=True)):
        ends = f'range="{joint.min_rad} {joint.max_rad}" {_STOP}' if limited else f'armature="{gear.rotor_kg_m2}"'
        axis = tuple(joint.sign * part for part in link.axis)
        text += (
            f'<body name="link{k}" pos="{_numbers(link.place_m)}">{_inertial(link)}'
            f'<joint name="joint{k}" axis="{_numbers(axis)}" ref="{joint.offset_rad}" {ends}/>{inside.get(k, "")}'
        )
    return text + "</body>" * len(LINKS)


def _inertial(link: Link) -> str:
    moments = (link.inertia_kg_m2,) * 3
    return f'<inertial pos="{_numbers(link.centre_m)}" mass="{link.mass_kg}" diaginertia="{_numbers(moments)}"/>'


def _rotor(k: int, joint: ExoskeletonJoint, gear: Gear) -> str:
    """A rotor turns by itself, felt at the joint; friction is the motor's and the gear's."""
    moments = _numbers((gear.rotor_kg_m2,) * 3)
    return (
        f'<body name="motor{k}"><inertial pos="0 0 0" mass="1" diaginertia="{moments}"/>'
        f'<joint name="rotor{k}" axis="0 0 1" ref="{joint.offset_rad}" damping="{gear.viscous_nm_s}"'
        f' frictionloss="{gear.coulomb_nm}"/></body>'
    )


def _gear(k: int, gear: Gear) -> str:
    """A spring between rotor and link that is slack within the play."""
    slack = f"{-gear.play_rad / 2} {gear.play_rad / 2}"
    return (
        f'<fixed stiffness="{gear.stiffness_nm_rad}" damping="{gear.damping_nm_s}" springlength="{slack}">'
        f'<joint joint="rotor{k}" coef="1"/><joint joint="joint{k}" coef="-1"/></fixed>'
    )


def _human(arm: HumanArm) -> str:
    upper, fore, hand = arm.segments
    wrist = f'stiffness="{arm.wrist_nm_rad}" damping="{arm.wrist_nm_s}"'
    return (
        f'<body name="upper arm" pos="{_numbers(arm.shoulder_m)}">{_mass(upper)}{_site("arm0", UPPER_CUFF)}'
        f'<joint type="ball" stiffness="{arm.shoulder_nm_rad}" damping="{arm.shoulder_nm_s}"/>'
        f'<body name="forearm" pos="0 {-upper.length_m} 0">{_mass(fore)}{_site("arm1", FOREARM_CUFF)}'
        f'<joint axis="1 0 0" stiffness="{arm.elbow_nm_rad}" springref="{arm.elbow_rest_rad}"'
        f' damping="{arm.elbow_nm_s}" range="{_numbers(ELBOW_RANGE_RAD)}"/>'
        f'<body name="hand" pos="0 {-fore.length_m} 0">{_mass(hand)}{_site("arm2", HANDLE)}'
        f'<joint axis="0 1 0" {wrist}/><joint axis="1 0 0" {wrist}/><joint axis="0 0 1" {wrist}/>'
        "</body></body></body>"
    )


def _mass(segment: Segment) -> str:
    moments = _numbers(segment.inertia_kg_m2)
    return f'<inertial pos="0 {-segment.centre_m} 0" mass="{segment.mass_kg}" diaginertia="{moments}"/>'


def _fixed(segment: Segment) -> str:
    return f"<body>{_mass(segment)}</body>"


def _site(name: str, cuff: Cuff) -> str:
    return f'<site name="{name}" pos="0 {-cuff.below_m} 0"/>'


def _cuff(k: int, cuff: Cuff) -> str:
    """Springs with damping between arm and shell, one per direction and turn that is held."""
    stiffness = (cuff.across_n_m, cuff.along_n_m, cuff.across_n_m, cuff.tilt_nm_rad, cuff.turn_nm_rad, cuff.tilt_nm_rad)
    return "".join(_spring(k, way, value) for way, value in enumerate(stiffness) if value)


def _spring(k: int, way: int, stiffness: float) -> str:
    ways = " ".join("1" if each == way else "0" for each in range(6))
    return (
        f'<general site="arm{k}" refsite="shell{k}" gear="{ways}" gainprm="0" biastype="affine"'
        f' biasprm="0 {-stiffness} {-CUFF_DAMPING_S * stiffness}"/>'
    )


def _numbers(values: Iterable[float]) -> str:
    return " ".join(map(str, values))
