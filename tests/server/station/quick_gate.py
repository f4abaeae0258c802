"""The gate before quick joints, for tests: the studies' own rig, opened and engaged."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from station_samples import patient_limits

from server.config import StationConfig
from server.experiments.gate.plant import QuickArm
from server.experiments.gate.rig import GOOD, TICK_S, GateRig, Scene
from server.experiments.gate.wild import near_target
from server.messages import Assistance, DriveState, Enable, JointLimits, SetAssistance, Wish
from server.station.exo import safety
from server.station.exo.driver import Joints
from server.station.exo.evidence import Device
from server.station.exo.mapping import JointTarget
from server.station.exo.patient_range import inside_device
from server.station.exo.softness import device_of

STATION = StationConfig()
LIMITS = inside_device(patient_limits(), STATION.device)
COMPLIANT = device_of(STATION.exoskeleton, can_comply=True)
RIGID = replace(COMPLIANT, can_comply=False)
HERE: Joints = (0.9, 0.6, 0.2, 1.0)
ELBOW = 3
STAYS = near_target(HERE)


def gate_rig(device: Device = COMPLIANT, limits: tuple[JointLimits, ...] = LIMITS) -> GateRig:
    rig = GateRig(limits, device, QuickArm(HERE))
    run(rig, 0.05)
    return rig


def engaged(
    mode: Assistance = Assistance.PASSIVE, level: float = 1.0, device: Device = COMPLIANT, seconds: float = 2.2
) -> GateRig:
    """The blend-in is over."""
    rig = gate_rig(device)
    if mode is not Assistance.PASSIVE:
        assert rig.wish(SetAssistance(number=1, mode=mode, level=level))
        run(rig, 0.02)
    assert rig.wish(Enable(number=2))
    run(rig, seconds)
    assert rig.now is DriveState.ENGAGED
    return rig


def run(
    rig: GateRig,
    seconds: float,
    target: JointTarget | Callable[[float], JointTarget] | None = STAYS,
    scene: Scene = GOOD,
) -> None:
    for _ in range(round(seconds / TICK_S)):
        rig.tick(target(rig.t_s) if callable(target) else target, scene=scene)


def at(*by: float) -> JointTarget:
    """A sure target so far from `HERE`."""
    return near_target(tuple(here + more for here, more in zip(HERE, by, strict=True)))


def refusal(rig: GateRig, wanted: Wish) -> str:
    """What a wish is answered."""
    return safety.wish(rig.state, wanted, rig.t_s)[1]
