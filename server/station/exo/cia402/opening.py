"""What a drive is asked and told before the loop begins: what it is, how it speaks, when it stops, what it may do."""

from __future__ import annotations

import time
from collections.abc import Callable
from math import log10

from fusion.errors import MachineError
from server.exoskeleton import Cia402Settings
from server.station.exo.cia402 import objects
from server.station.exo.cia402.bounds import device_bounds, impose, impose_torque
from server.station.exo.cia402.bus import NMT_PRE_OPERATIONAL, NMT_START, OPERATIONAL, Bus
from server.station.exo.cia402.link import Link
from server.station.exo.cia402.objects import Entry
from server.station.exo.cia402.pdo import PDOS
from server.station.exo.cia402.sdo import Parameters
from server.station.exo.cia402.states import HOMING_ATTAINED
from server.station.exo.cia402.units import Units

QUICK_STOP = 3
"""Of 6007h: a drive that no longer hears the station makes its quick stop."""
STAY_HOLDING = 6
"""Of 605Ah: brake on the quick stop's ramp, then hold, powered."""
BRAKE_THEN_OFF = 2
"""Of 605Eh: in a fault brake on the quick stop's ramp, then let the holding brake take over."""
SILENT_AFTER_BEATS = 2
"""Of the settings' heartbeat: from then on the other side is gone."""
WITHIN_S = 1.0
"""A drive that has not changed its mode, or said that it lives, by then does not."""


def open_node(node: Parameters, bus: Bus, settings: Cia402Settings) -> Units:
    """Make a drive ready for the loop; it does not move and is not powered by this.

    Returns:
        The joint's units, by the motor's rated torque.

    Raises:
        MachineError: it is absent, no CiA 402 drive, not homed, or takes a setting otherwise than the file says.
    """
    units = prepare(node, bus, settings)
    _cycle(node, settings.period_s)
    impose(node, device_bounds(node.place.joint), units)
    impose_torque(node, units)
    expect_homed(node, settings)
    set_mode(node, objects.CYCLIC_POSITION)
    return units


def prepare(node: Parameters, bus: Bus, settings: Cia402Settings) -> Units:
    """Find out what a node is, and tell it when to stop by itself.

    Returns:
        The joint's units, by the motor's rated torque.

    Raises:
        MachineError: it is absent, no CiA 402 drive, or takes a setting otherwise than the file says.
    """
    _identify(node)
    bus.command(NMT_PRE_OPERATIONAL, node.place.joint.node)
    rated_mnm = node.read(objects.RATED_TORQUE)
    if not rated_mnm:
        raise MachineError(f"{node.place} does not know its motor: its {objects.RATED_TORQUE} reads 0", "mN m")
    _expect_units(node)
    _when_to_stop(node, settings)
    return Units.of(node.place.joint, rated_mnm / 1000)


def start_node(node: Parameters, bus: Bus) -> None:
    """Let the drive's process data flow."""
    bus.command(NMT_START, node.place.joint.node)


def expect_heartbeat(node: Parameters, link: Link, settings: Cia402Settings) -> None:
    """Wait for the started drive's heartbeat.

    Raises:
        MachineError: none came.
    """
    if not _within(lambda: link.network_state == OPERATIONAL, WITHIN_S + SILENT_AFTER_BEATS * settings.heartbeat_s):
        raise MachineError(
            f"{node.place} sends no heartbeat",
            f"a heartbeat that says operational, by its {objects.PRODUCER_HEARTBEAT} from cia402.heartbeat_s",
            "check that the drive can produce heartbeats",
        )


def set_mode(node: Parameters, mode: int) -> None:
    """Change the mode of operation and wait until the drive shows it.

    Raises:
        MachineError: it does not.
    """
    if not node.read(objects.SUPPORTED_MODES) & objects.MODE_BITS[mode]:
        raise MachineError(f"{node.place} has no mode {mode}", "cyclic synchronous position (8) and homing (6)")
    node.write(objects.MODE, mode)
    if not _within(lambda: node.read(objects.MODE_SHOWN) == mode):
        raise MachineError(f"{node.place} does not change to mode {mode} of operation")


def expect_homed(node: Parameters, settings: Cia402Settings) -> None:
    """Refuse a drive that does not know where it stands; in homing mode its statusword says so (bit 12).

    Raises:
        MachineError: it has not been homed since its power came.
    """
    if settings.homing_method == 0:
        return
    set_mode(node, objects.HOMING)
    if not node.read(objects.STATUSWORD) & HOMING_ATTAINED:
        raise MachineError(
            f"{node.place} is not homed: it does not know where it stands",
            "homing attained (bit 12 of its statusword), by cia402.homing_method",
            "with nobody in the device: mirrorlimb exoskeleton home FILE",
        )


def _identify(node: Parameters) -> None:
    profile = node.read(objects.DEVICE_TYPE) & 0xFFFF
    if profile != objects.PROFILE_402:
        raise MachineError(
            f"{node.place} is no drive: its {objects.DEVICE_TYPE} names profile {profile}",
            "profile 402",
            f"check {node.place.key('node')}",
        )


def _expect_units(node: Parameters) -> None:
    """What would turn the joint the wrong way or too far."""
    if node.has(objects.POLARITY):
        node.expect(objects.POLARITY, 0, node.place.key("sign"))
    if node.has(objects.ENCODER_TURNS):
        turns = node.read(objects.ENCODER_TURNS)
        key = node.place.key("counts_per_turn")
        node.expect(objects.ENCODER_COUNTS, turns * node.place.joint.counts_per_turn, key)


def _when_to_stop(node: Parameters, settings: Cia402Settings) -> None:
    """Heartbeats both ways, and what the drive does by itself when it misses ours (SR-3)."""
    beat_ms = round(1000 * settings.heartbeat_s)
    node.set(objects.PRODUCER_HEARTBEAT, beat_ms, "cia402.heartbeat_s")
    expect_station(node, settings, SILENT_AFTER_BEATS * beat_ms)
    node.set(objects.ABORT_OPTION, QUICK_STOP, "SR-3")
    node.set(objects.QUICK_STOP_OPTION, STAY_HOLDING, "SR-7")
    node.set(objects.FAULT_REACTION_OPTION, BRAKE_THEN_OFF, "SR-7")
    deceleration = Units.of(node.place.joint, 1.0).counts(node.place.joint.acceleration_rad_s2)
    node.set(objects.QUICK_STOP_DECELERATION, deceleration, node.place.key("acceleration_rad_s2"))


def expect_station(node: Parameters, settings: Cia402Settings, within_ms: int) -> None:
    """Tell the drive how long it may hear nothing from the station; 0 = it need not expect it any more.

    Raises:
        MachineError: it does not take it.
    """
    node.set(objects.CONSUMER_HEARTBEAT, settings.own_node << 16 | within_ms, "cia402.heartbeat_s")


def _cycle(node: Parameters, period_s: float) -> None:
    """Process data with each SYNC, and the time between two set-points."""
    for pdo in PDOS:
        for entry, value in pdo.settings(node.place.joint.node):
            node.write(entry, value)
    exponent = -3 if round(period_s * 1000) >= 1 else round(log10(period_s))
    node.set(objects.INTERPOLATION_EXPONENT, exponent, "cia402.period_s")
    node.set(objects.INTERPOLATION_TIME, round(period_s / 10.0**exponent), "cia402.period_s")


def _within(true: Callable[[], bool], within_s: float = WITHIN_S) -> bool:
    end_s = time.monotonic() + within_s
    while not true():
        if time.monotonic() > end_s:
            return False
        time.sleep(0.002)
    return True


def history(node: Parameters) -> tuple[int, int]:
    """The drive's error register (1001h) and the newest error of its own list (1003h); 0 = none."""
    newest = Entry(0x1003, 0, "B", "number of errors")
    listed = node.has(newest) and node.read(newest) > 0
    return node.read(objects.ERROR_REGISTER), node.read(objects.LAST_ERROR) & 0xFFFF if listed else 0
