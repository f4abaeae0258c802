"""An emulated drive without its bus: state machine and motor, obeying what its objects hold."""

from __future__ import annotations

from collections.abc import Callable
from math import ceil, pi
from typing import Final

from server.emulated.cia402 import machine
from server.emulated.cia402.motor import Limits, Motor
from server.emulated.cia402.store import RATED_MOTOR_NM
from server.exoskeleton import ExoskeletonJoint
from server.station.exo.cia402 import objects
from server.station.exo.cia402.faults import FOLLOWING_ERROR
from server.station.exo.cia402.objects import Entry
from server.station.exo.cia402.states import HOMING_ATTAINED, INTERNAL_LIMIT, State

STEP_S = 0.002
LONGEST_CATCH_UP_S = 0.1
"""An emulation that was held up for longer skips ahead, as no real motor would."""
FOLLOWING_RAD, FOLLOWING_S = 0.3, 0.1
"""Further than this from its set-point for this long: following error."""
HOMING_RAD_S = 0.3
_HERE: Final = (35, 37)
"""Homing methods that take the present position."""
_START_HOMING = 1 << 4


class EmulatedDrive:
    """One joint's drive and motor.

    Args:
        joint: the joint it moves.
        values: its objects; read here, written by the bus.
        start_rad: where the joint stands when its power comes.
        complain: told of each error code.
    """

    def __init__(
        self, joint: ExoskeletonJoint, values: dict[Entry, int], start_rad: float, complain: Callable[[int], None]
    ) -> None:
        self.values, self.motor, self.state = values, Motor(start_rad), State.DISABLED
        self.motor.stand()
        self.control = 0
        self._complain = complain
        self._counts_per_rad = joint.counts_per_turn * joint.gear_ratio / (2 * pi)
        self._rated_nm = RATED_MOTOR_NM * joint.gear_ratio
        self._zero_rad, self._homed, self._limited = 0.0, True, False
        self._far_s = 0.0

    # ---------------------------------------------------------------- what it shows

    @property
    def statusword(self) -> int:
        """State, homing attained and internal limit."""
        homed = HOMING_ATTAINED if self._homed and self.values[objects.MODE] == objects.HOMING else 0
        return machine.statusword(self.state) | homed | (INTERNAL_LIMIT if self._limited else 0)

    @property
    def shown(self) -> dict[Entry, int]:
        """The measured objects."""
        return {
            objects.STATUSWORD: self.statusword,
            objects.POSITION: self.counts(self.motor.angle_rad - self._zero_rad),
            objects.VELOCITY: self.counts(self.motor.velocity_rad_s),
            objects.TORQUE: round(1000 * self.motor.torque_nm / self._rated_nm),
            objects.MODE_SHOWN: self.values[objects.MODE],
        }

    def counts(self, angle_rad: float) -> int:
        """An angle in the encoder's counts."""
        return round(angle_rad * self._counts_per_rad)

    # ---------------------------------------------------------------- what is done to it

    def obey(self, control: int) -> None:
        """A controlword."""
        before, self.state = self.state, machine.after(self.state, control, self.control)
        self.control = control
        if self.state is State.ENABLED and before is not State.ENABLED:
            self.motor.stand()

    def head_for(self, target: int, over_s: float) -> None:
        """A set-point in counts, to be reached over the interpolation time."""
        if self.state is State.ENABLED and self.values[objects.MODE] == objects.CYCLIC_POSITION:
            self._limited = self.motor.head_for(target / self._counts_per_rad + self._zero_rad, over_s, self._limits())

    def fail(self, code: int) -> None:
        """Have an error: brake, then fault."""
        self.state = State.FAULT_REACTION if self.state in machine.POWERED else State.FAULT
        self._complain(code)

    def quick_stop(self) -> None:
        """Brake and hold, because nobody is heard any more."""
        if self.state is State.ENABLED:
            self.state = State.QUICK_STOP

    def forget(self) -> None:
        """Not to know any more where it stands."""
        self._homed, self._zero_rad = False, self.motor.angle_rad

    def advance(self, elapsed_s: float, now_s: float) -> None:
        """The motor's movement up to now."""
        elapsed_s = min(elapsed_s, LONGEST_CATCH_UP_S)
        steps = ceil(elapsed_s / STEP_S)
        for _ in range(steps):
            self._move(elapsed_s / steps)
        self._watch_following(now_s)

    # ---------------------------------------------------------------- inside

    def _move(self, dt_s: float) -> None:
        if self.state not in machine.POWERED:
            self.motor.rest_on_brake()
            return
        self._lead(dt_s)
        self.motor.drive(self._limits(), dt_s)
        if self.state is State.FAULT_REACTION and not self.motor.reference_rad_s:
            self.state = State.FAULT

    def _lead(self, dt_s: float) -> None:
        """Where the regulator is to bring the joint next."""
        if self.state is not State.ENABLED:
            self.motor.brake(self.values[objects.QUICK_STOP_DECELERATION] / self._counts_per_rad, dt_s)
        elif self.values[objects.MODE] == objects.HOMING:
            self._seek_home(dt_s)
        else:
            self.motor.interpolate(dt_s)

    def _seek_home(self, dt_s: float) -> None:
        """Either here is home, or the switch at the joint's true zero is."""
        if not self.control & _START_HOMING or self._homed:
            return
        if self.values[objects.HOMING_METHOD] in _HERE:
            self._zero_rad, self._homed = self.motor.angle_rad, True
            return
        step_rad = HOMING_RAD_S * dt_s
        self.motor.reference_rad += min(max(-self.motor.reference_rad, -step_rad), step_rad)
        self.motor.goal_rad = self.motor.reference_rad
        if abs(self.motor.angle_rad) < 1e-3:
            self._zero_rad, self._homed = 0.0, True

    def _watch_following(self, now_s: float) -> None:
        near = abs(self.motor.reference_rad - self.motor.angle_rad) < FOLLOWING_RAD
        if near or self.state is not State.ENABLED:
            self._far_s = now_s
        elif now_s - self._far_s > FOLLOWING_S:
            self.fail(FOLLOWING_ERROR)

    def _limits(self) -> Limits:
        held = self.values
        return Limits(
            held[objects.MIN_POSITION] / self._counts_per_rad + self._zero_rad,
            held[objects.MAX_POSITION] / self._counts_per_rad + self._zero_rad,
            held[objects.MAX_PROFILE_VELOCITY] / self._counts_per_rad,
            held[objects.MAX_TORQUE] * self._rated_nm / 1000,
        )
