"""The exoskeleton on a CANopen bus: opened and checked, commanded and read once per tick, closed holding."""

from __future__ import annotations

import logging
import time
from concurrent.futures import Future, ThreadPoolExecutor
from math import copysign, isinf
from types import TracebackType
from typing import Self

import numpy as np

from fusion.errors import InputError, MachineError
from fusion.messages import Floats
from server.exoskeleton import Exoskeleton, ExoskeletonJoint, Follows
from server.messages import JointLimits
from server.station.exo.cia402 import objects
from server.station.exo.cia402.bounds import device_bounds, expect_inside, expect_rest, impose, patient_bounds
from server.station.exo.cia402.bus import Bus
from server.station.exo.cia402.faults import words
from server.station.exo.cia402.following import Following
from server.station.exo.cia402.guard import Guard
from server.station.exo.cia402.link import Link, Measured
from server.station.exo.cia402.opening import (
    SILENT_AFTER_BEATS,
    expect_heartbeat,
    expect_station,
    history,
    open_node,
    start_node,
)
from server.station.exo.cia402.pdo import load
from server.station.exo.cia402.sdo import Parameters, Place
from server.station.exo.cia402.setpoint import SetPoint
from server.station.exo.cia402.states import State, controlword
from server.station.exo.cia402.units import Units
from server.station.exo.cia402.watch import Patience, trouble
from server.station.exo.driver import DriveCommand, DriveReading
from server.station.exo.joint_map import JointMap

log = logging.getLogger(__name__)

STAND_WITHIN_S = 0.5
"""At the end: from quick stop to every drive standing."""
FULLEST = 0.8
"""Share of the bus that a cycle may take."""


class Cia402Drive:
    """A device of CiA 402 drives.

    A fault of one drive stops all of them by their own quick stop, powered and holding, until `reset`.

    Args:
        exoskeleton: its joints, each with a node of its own.

    Raises:
        InputError: the bus is too slow for so many joints; names the key and what was expected.
    """

    name = "cia402"

    def __init__(self, exoskeleton: Exoskeleton) -> None:
        check_load(exoskeleton)
        self._exoskeleton, self._settings = exoskeleton, exoskeleton.cia402
        self._map = JointMap(exoskeleton)
        silent_s = SILENT_AFTER_BEATS * self._settings.heartbeat_s
        self._patience = Patience(silent_s, round(silent_s / self._settings.period_s))
        self._rests = np.array([joint.follows is Follows.NONE for joint in exoskeleton.joints])  # (n,) held where it is
        led = [joint for joint in exoskeleton.joints if joint.follows is not Follows.NONE]
        self.can_comply = all(joint.name in self._settings.carry_nm for joint in led)
        self._soft = np.zeros(len(exoskeleton.joints), dtype=bool)
        self._following = Following(exoskeleton.joints)
        self._errands = ThreadPoolExecutor(1, "canopen errand")
        self._limits: tuple[JointLimits, ...] = ()
        self._fitting: Future[None] | None = None
        self._told_s: float | None = None

    # ---------------------------------------------------------------- open and close

    def __enter__(self) -> Self:
        self._bus = Bus(self._settings)
        joints = self._exoskeleton.joints
        self._links = [Link(joint, self._bus) for joint in joints]
        self._guard = Guard(self._links, self._patience)
        self._nodes = [Parameters(Place(i, joint), self._bus.sdo(joint.node)) for i, joint in enumerate(joints)]
        self._bus.start()
        try:
            self._units = [open_node(node, self._bus, self._settings) for node in self._nodes]
            for node in self._nodes:
                start_node(node, self._bus)
            for node, link in zip(self._nodes, self._links, strict=True):
                self._meet(node, link)
            self._set_point = SetPoint.standing(self._joints_rad())
            for node, angle in zip(self._nodes, self._joints_rad().tolist(), strict=True):
                expect_inside(node.place, angle, device_bounds(node.place.joint), "its own range")
                expect_rest(node.place, angle)
        except BaseException:
            self._errands.shutdown()
            self._bus.close()
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Every drive makes its quick stop and goes on holding, powered, without the station."""
        self._errands.shutdown(cancel_futures=True)
        self._guard.stand()
        end_s = time.monotonic() + STAND_WITHIN_S
        while any(link.state is State.ENABLED for link in self._links) and time.monotonic() < end_s:
            self._send([joint.torque_nm for joint in self._exoskeleton.joints])
            time.sleep(self._settings.period_s)
        self._release()
        self._bus.close()

    def _meet(self, node: Parameters, link: Link) -> None:
        """Hear it, and remember where it stands until it says so itself."""
        expect_heartbeat(node, link, self._settings)
        link.measured = Measured(node.read(objects.STATUSWORD), node.read(objects.POSITION))
        _note(node)

    def _release(self) -> None:
        """Drives that stand need not expect the station any longer; one that does not stand goes on doing so."""
        for node, link in zip(self._nodes, self._links, strict=True):
            if link.state is State.QUICK_STOP and not trouble(link, self._patience, time.monotonic()):
                try:
                    expect_station(node, self._settings, 0)
                except MachineError as refused:
                    log.warning("%s", refused)

    # ---------------------------------------------------------------- a tick

    def read(self, now_s: float) -> DriveReading:
        """The measurement that answered the newest SYNC."""
        if self._guard.judge(now_s, self._bus.trouble or self._refused_range() or self._strayed(now_s)):
            self._errands.submit(self._note_all)
        links = list(zip(self._links, self._units, strict=True))
        return DriveReading(
            now_s,
            self._map.anatomical_rad(self._joints_rad()),
            self._map.anatomical_rad_s([units.rad(link.details.velocity) for link, units in links]),
            self._map.anatomical_nm([units.nm(link.measured.torque) for link, units in links]),
            self._guard.said,
            self._map.anatomical_nm([self._interaction_nm(link, units) for link, units in links]),
        )

    def command(self, command: DriveCommand, now_s: float) -> None:
        """Send every joint its set-point, then the SYNC that lets all take it over, then the station's heartbeat."""
        elapsed_s = 0.0 if self._told_s is None else max(now_s - self._told_s, 0.0)
        self._told_s = now_s
        share = self._map.spread(command.share, 1.0)
        bound_nm = self._map.spread(command.torque_nm, float("inf"))
        measured = self._joints_rad()
        self._soft = share < 1
        if not self._guard.powered or self._is_fitting():
            self._set_point = SetPoint.standing(measured)
        else:
            wanted = np.where(self._rests, self._set_point.joints_rad, self._map.joints_rad(command.angle_rad))
            joined = self._set_point.towards(command.mode, wanted, measured, elapsed_s)
            self._set_point = joined.yielding(self._soft, measured)
        self._send([self._limit_nm(*each) for each in zip(self._exoskeleton.joints, share, bound_nm, strict=True)])

    def fit(self, limits: tuple[JointLimits, ...]) -> None:
        """Tell the drives the patient's range, in a thread of its own; until they have taken it, nothing moves.

        The range is written into the drives (SR-1) and read back; a drive that does not take it is a fault.
        """
        self._set_point = SetPoint.standing(self._joints_rad())
        self._limits, self._fitting = limits, self._errands.submit(self._impose, limits)

    def reset(self) -> None:
        """A person asks: leave the fault, and hold where the joints stand. Motion is another wish (SR-5).

        A patient's range is told again: it may be what was refused, and a drive that restarted has forgotten it.
        """
        if self._guard.fault:
            self._bus.trouble = ""
            self._guard.reset()
            if self._limits:
                self.fit(self._limits)

    # ---------------------------------------------------------------- the patient's range

    def _refused_range(self) -> str:
        if self._fitting is None or not self._fitting.done():
            return ""
        error = self._fitting.exception()
        return str(error) if error else ""

    def _strayed(self, now_s: float) -> str:
        if not self._guard.powered:
            self._following.begin()
            return ""
        return self._following.judge(self._set_point.joints_rad, self._joints_rad(), self._soft, now_s)

    def _is_fitting(self) -> bool:
        return self._fitting is not None and not self._fitting.done()

    # ---------------------------------------------------------------- what goes out

    def _joints_rad(self) -> Floats:
        measured = [units.rad(link.measured.position) for link, units in zip(self._links, self._units, strict=True)]
        return np.array(measured)

    def _send(self, limits_nm: list[float]) -> None:
        every = zip(self._links, self._units, self._set_point.joints_rad.tolist(), limits_nm, strict=True)
        for link, units, angle, limit_nm in every:
            inside = min(max(angle, link.joint.min_rad), link.joint.max_rad)
            link.send(controlword(link.state, self._guard.wanted), units.counts(inside), units.per_mille(limit_nm))
        self._bus.sync()
        self._bus.beat()

    def _interaction_nm(self, link: Link, units: Units) -> float:
        """What the motor gives beyond the most that weight can ask: so much at least is the arm's doing."""
        used_nm, carry_nm = units.nm(link.measured.torque), self._settings.carry_nm.get(link.joint.name)
        return 0.0 if carry_nm is None else -copysign(max(abs(used_nm) - carry_nm, 0.0), used_nm)

    def _limit_nm(self, joint: ExoskeletonJoint, share: float, bound_nm: float) -> float:
        """The most that the motor may use: what carries the arm, and what it may add (docs/cia402.md)."""
        carry_nm = self._settings.carry_nm.get(joint.name)
        if carry_nm is None or (share >= 1 and isinf(bound_nm)):
            return joint.torque_nm
        return min(joint.torque_nm, carry_nm + min(bound_nm, share * joint.torque_nm))

    # ---------------------------------------------------------------- errands, outside the tick

    def _impose(self, limits: tuple[JointLimits, ...]) -> None:
        allowed = patient_bounds(self._exoskeleton, limits)
        for node, angle, bounds in zip(self._nodes, self._joints_rad().tolist(), allowed, strict=True):
            expect_inside(node.place, angle, bounds, "the patient's range")
        for node, bounds, units in zip(self._nodes, allowed, self._units, strict=True):
            impose(node, bounds, units, "the patient's range")

    def _note_all(self) -> None:
        for node in self._nodes:
            _note(node)


def check_load(exoskeleton: Exoskeleton) -> None:
    """Refuse a bus that is too slow for its joints.

    Raises:
        InputError: names the key and what was expected.
    """
    settings = exoskeleton.cia402
    full = load(len(exoskeleton.joints), settings.period_s, settings.bitrate)
    if full > FULLEST:
        raise InputError(
            f"cia402.bitrate: {len(exoskeleton.joints)} joints every {settings.period_s} s fill {full:.0%} of the bus",
            f"at most {FULLEST:.0%}",
            "a higher bit rate, or a longer cia402.period_s with a slower station.rate_hz",
        )


def _note(node: Parameters) -> None:
    """Write what the drive remembers of errors into the log."""
    try:
        register, newest = history(node)
    except MachineError as silent:
        log.warning("%s", silent)
        return
    if register or newest:
        log.warning("%s remembers: register %02Xh, %s", node.place, register, words(newest) if newest else "no error")
