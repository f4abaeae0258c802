"""Homing: a drive finds out where it stands, by its own method, one joint at a time and with nobody in the device."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Final

from fusion.errors import MachineError
from server.exoskeleton import Exoskeleton, ExoskeletonJoint
from server.station.exo.cia402 import objects
from server.station.exo.cia402.bounds import device_bounds, impose, impose_torque
from server.station.exo.cia402.bus import Bus
from server.station.exo.cia402.faults import words
from server.station.exo.cia402.link import Link
from server.station.exo.cia402.opening import expect_heartbeat, expect_station, prepare, set_mode, start_node
from server.station.exo.cia402.sdo import Parameters, Place
from server.station.exo.cia402.states import (
    HOMING_ATTAINED,
    HOMING_ERROR,
    QUICK_STOP,
    START_HOMING,
    State,
    Wanted,
    controlword,
    state_of,
)

POWER_WITHIN_S, HOME_WITHIN_S = 1.0, 60.0
_LOOK_S: Final = 0.01


def is_homed(exoskeleton: Exoskeleton, name: str) -> bool:
    """Whether a joint's drive knows where it stands.

    Raises:
        MachineError: the drive does not answer.
    """
    with _Homing(exoskeleton, name) as homing:
        return homing.attained


def home(exoskeleton: Exoskeleton, name: str) -> None:
    """Home one joint: it may move through its whole range, so nobody is in the device. Ends powered and holding.

    The drive expects the station's heartbeat meanwhile: if this process dies, the joint stops.

    Args:
        exoskeleton: its `cia402.homing_method` says how.
        name: of the joint.

    Raises:
        MachineError: the drive does not answer, does not power up, or did not find its home.
    """
    with _Homing(exoskeleton, name) as homing:
        homing.power()
        homing.seek()
        homing.stand()


class _Homing:
    def __init__(self, exoskeleton: Exoskeleton, name: str) -> None:
        places = {joint.name: Place(index, joint) for index, joint in enumerate(exoskeleton.joints)}
        self._settings, self._place = exoskeleton.cia402, places[name]
        self._bus = Bus(self._settings)
        self._link = Link(self._joint, self._bus)
        self._node = Parameters(self._place, self._bus.sdo(self._joint.node))

    def __enter__(self) -> _Homing:
        self._bus.start()
        try:
            units = prepare(self._node, self._bus, self._settings)
            impose(self._node, device_bounds(self._joint), units)
            impose_torque(self._node, units)
            start_node(self._node, self._bus)
            expect_heartbeat(self._node, self._link, self._settings)
            set_mode(self._node, objects.HOMING)
        except BaseException:
            self._bus.close()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        self._bus.close()

    @property
    def _joint(self) -> ExoskeletonJoint:
        return self._place.joint

    @property
    def _statusword(self) -> int:
        return self._node.read(objects.STATUSWORD)

    @property
    def attained(self) -> bool:
        return bool(self._statusword & HOMING_ATTAINED)

    def power(self) -> None:
        self._node.write(objects.HOMING_METHOD, self._settings.homing_method)
        self._until(lambda status: state_of(status) is State.ENABLED, POWER_WITHIN_S, "power up", self._climb)

    def seek(self) -> None:
        self._node.write(objects.CONTROLWORD, START_HOMING)
        self._until(lambda status: bool(status & HOMING_ATTAINED), HOME_WITHIN_S, "find its home")

    def stand(self) -> None:
        """Hold by the quick stop, which needs no station."""
        self._node.write(objects.CONTROLWORD, QUICK_STOP)
        self._until(lambda status: state_of(status) is State.QUICK_STOP, POWER_WITHIN_S, "stand")
        expect_station(self._node, self._settings, 0)

    def _climb(self, status: int) -> None:
        self._node.write(objects.CONTROLWORD, controlword(state_of(status), Wanted.ENABLED))

    def _until(
        self,
        true: Callable[[int], bool],
        within_s: float,
        what: str,
        meanwhile: Callable[[int], None] = lambda status: None,
    ) -> None:
        end_s = time.monotonic() + within_s
        while not true(status := self._statusword):
            if status & HOMING_ERROR or self._link.emergency or time.monotonic() > end_s:
                told = f": {words(self._link.emergency)}" if self._link.emergency else f" ({state_of(status)})"
                raise MachineError(
                    f"{self._place} did not {what}{told}",
                    f"homing by method {self._settings.homing_method} (cia402.homing_method)",
                    "check limit switches, enable input and homing speed (6099h)",
                )
            self._bus.beat()
            meanwhile(status)
            time.sleep(_LOOK_S)
