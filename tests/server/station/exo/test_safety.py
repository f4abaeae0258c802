"""The safety gate with the simulated drive behind it: no input takes command or joint out of its limits."""

from __future__ import annotations

import random
from dataclasses import dataclass, field, replace
from math import isfinite, nan

import msgspec
import pytest
from station_samples import patient_limits

from server.config import GateConfig, StationConfig
from server.messages import DriveState, Enable, Reset, Resume, Stop, Wish
from server.station.exo import safety
from server.station.exo.driver import ZERO, DriveCommand, DriveMode, DriveReading
from server.station.exo.evidence import SafetyInputs
from server.station.exo.gate import GateState
from server.station.exo.mapping import JointTarget
from server.station.exo.patient_range import boxes, inside_device, refused
from server.station.exo.safety_state import SafetyState
from server.station.exo.simulated import AT_REST, SimulatedDrive
from server.station.exo.simulated_arm.person import Spasticity
from server.station.exo.softness import device_of

STATION = StationConfig()
CONFIG = STATION.gate
LIMITS = inside_device(patient_limits(), STATION.device)
BOXES = boxes(LIMITS, CONFIG)
DEVICE = device_of(STATION.exoskeleton, can_comply=True)
DT_S = 0.01
FREE = (1.0,) * 4
SURE = (0.1,) * 4
TICKS = 1_500
SAG_RAD = 0.01
"""How far an arm may be measured from its set-point while it is held."""


def target(angle: tuple[float, ...] = AT_REST, **change: tuple[float, ...]) -> JointTarget:
    return replace(JointTarget(angle, ZERO, SURE, FREE), **change)


def moved(*by: float) -> tuple[float, ...]:
    return tuple(rest + more for rest, more in zip(AT_REST, by, strict=True))


@dataclass
class Rig:
    """The gate in closed loop with the simulated drive, a tick at a time."""

    state: SafetyState = field(default_factory=lambda: SafetyState(gate=GateState(DriveState.READY, "", 0.0, True)))
    drive: SimulatedDrive = field(default_factory=lambda: SimulatedDrive(STATION.exoskeleton))
    t_s: float = 0.0
    command: DriveCommand = field(default_factory=lambda: DriveCommand(DriveMode.HOLD, AT_REST, ZERO, ""))
    reading: DriveReading = field(default_factory=lambda: DriveReading(0.0, AT_REST, ZERO, ZERO))
    config: GateConfig = CONFIG

    def tick(
        self, wanted: JointTarget | None, age_s: float = 0.0, reading: DriveReading | None = None, **change: object
    ) -> DriveCommand:
        self.t_s += DT_S
        self.reading = self.drive.read(self.t_s) if reading is None else replace(reading, t_s=self.t_s)
        inputs = SafetyInputs(self.reading, wanted, age_s, 0.0, LIMITS, BOXES, authority="therapist", device=DEVICE)
        self.state, self.command = safety.step(self.state, replace(inputs, **change), self.config, self.t_s)
        self.drive.command(self.command, self.t_s)
        return self.command

    def run(self, seconds: float, wanted: JointTarget | None, age_s: float = 0.0, **change: object) -> None:
        for _ in range(round(seconds / DT_S)):
            self.tick(wanted, age_s, **change)

    def wish(self, wanted: Wish) -> str:
        self.state, refusal = safety.wish(self.state, wanted, self.t_s)
        return refusal

    @property
    def now(self) -> DriveState:
        return self.state.gate.state


def engaged(wanted: JointTarget | None = None, seconds: float = 0.0) -> Rig:
    rig = Rig()
    rig.run(0.05, wanted or target())
    assert rig.wish(Enable(number=1)) == ""
    rig.run(seconds, wanted or target())
    return rig


def _anything(source: random.Random) -> JointTarget | None:
    """Mostly wild jumps; one in fifty is nothing, too short, not a number or beyond all bounds."""

    def row(scale: float) -> list[float]:
        return [source.gauss(0.7, scale) for _ in range(4)]

    angle, velocity = row(1.0), row(3.0)
    if source.random() < 0.02:
        spoilt = source.choice((angle, velocity))
        spoilt[source.randrange(4)] = source.choice((nan, float("inf"), -float("inf"), 1e300))
        del spoilt[source.choice((3, 4)) :]
    bound = tuple(abs(source.gauss(0, 0.3)) for _ in range(4))
    freedom = tuple(source.choice((1.0, 1.0, source.random())) for _ in range(4))
    made = JointTarget(tuple(angle), tuple(velocity), bound, freedom)
    return None if source.random() < 0.005 else made


@pytest.mark.parametrize("seed", range(4))
def test_sr1_sr2_no_random_target_takes_command_or_simulated_joint_out_of_its_limits(seed: int) -> None:
    print(f"seed {seed}")
    source, rig, wanted = random.Random(seed), engaged(), target()
    followed = 0
    for _ in range(TICKS):
        if source.random() < 0.2:
            wanted = _anything(source)
        before = rig.command
        began = not rig.state.following
        rig.tick(wanted, source.choice((0.02, 0.08, 0.2)) if source.random() < 0.02 else 0.0)
        if not (began and rig.state.following):  # the first set-point is the measured position
            _check_step(before, rig.command)
        _check_measured(rig.reading)
        followed += rig.state.following
        if rig.now is not DriveState.ENGAGED and source.random() < 0.1:
            rig.run(0.5, target(rig.reading.angle_rad))
            rig.wish(Resume(number=1))
        assert rig.now is not DriveState.FAULT
    assert followed > TICKS // 5


def _check_step(before: DriveCommand, after: DriveCommand) -> None:
    for i, (joint, box) in enumerate(zip(LIMITS, BOXES, strict=True)):
        assert isfinite(after.angle_rad[i])
        # A set-point begins where the arm is measured, and that may lie a little inside the soft margin.
        assert box.low_rad - SAG_RAD <= after.angle_rad[i] <= box.high_rad + SAG_RAD
        assert abs(after.angle_rad[i] - before.angle_rad[i]) <= joint.velocity_rad_s * DT_S + 1e-9
        assert abs(after.velocity_rad_s[i]) <= joint.velocity_rad_s + 1e-9
        change = abs(after.velocity_rad_s[i] - before.velocity_rad_s[i])
        assert change <= joint.acceleration_rad_s2 * DT_S + 1e-9


def _check_measured(reading: DriveReading) -> None:
    for angle, velocity, joint in zip(reading.angle_rad, reading.velocity_rad_s, LIMITS, strict=True):
        assert joint.min_rad <= angle <= joint.max_rad
        assert abs(velocity) <= 1.2 * joint.velocity_rad_s


def test_sr1_limits_that_cannot_be_used_are_refused_in_words() -> None:
    assert refused(LIMITS, STATION.device) == ""
    assert "plane, elevation, rotation, elbow" in refused(LIMITS[:3], STATION.device)
    for change, word in (
        ({"min_rad": nan}, "not all numbers"),
        ({"velocity_rad_s": 0.0}, "above 0"),
        ({"max_rad": -0.4}, "leave less"),
        ({"min_rad": 3.0, "max_rad": 3.5}, "outside the device"),
    ):
        bad = (msgspec.structs.replace(LIMITS[0], **change), *LIMITS[1:])
        assert word in refused(bad, STATION.device)
        assert "'plane'" in refused(bad, STATION.device)


def test_sr1_a_patients_range_is_cut_to_the_devices_own() -> None:
    wide = tuple(msgspec.structs.replace(joint, min_rad=-9.0, max_rad=9.0, velocity_rad_s=99.0) for joint in LIMITS)
    cut = inside_device(wide, STATION.device)
    assert [(j.min_rad, j.max_rad, j.velocity_rad_s) for j in cut] == [
        (j.min_rad, j.max_rad, j.velocity_rad_s) for j in STATION.device
    ]


def test_sr2_sr18_a_patients_torque_and_resistance_are_cut_to_the_devices_own() -> None:
    strong = tuple(msgspec.structs.replace(joint, torque_nm=999.0, resistance_nm=999.0) for joint in LIMITS)
    for joint, device in zip(inside_device(strong, STATION.device), STATION.device, strict=True):
        assert joint.torque_nm == joint.resistance_nm == device.torque_nm


def test_sr1_the_soft_margin_is_kept_for_a_target_outside_the_range_and_said() -> None:
    rig = engaged()
    for step in range(400):
        rig.tick(target((*AT_REST[:3], min(AT_REST[3] + step * 0.01, 3.0))))
    assert rig.command.angle_rad[3] == pytest.approx(LIMITS[3].max_rad - CONFIG.soft_margin_rad, abs=1e-3)
    assert any("elbow: at the end of its range" in words for words in rig.command.clamped)


@pytest.mark.parametrize("part", ["angle_rad", "velocity_rad_s", "bound_rad", "freedom"])
@pytest.mark.parametrize("wrong", [(nan, 0.3, 0.0, 0.6), (0.6, 0.3, 0.0), (0.6, float("inf"), 0.0, 0.6)])
def test_sr2_nan_infinity_and_wrong_lengths_are_refused_and_hold(part: str, wrong: tuple[float, ...]) -> None:
    rig = engaged(seconds=0.1)
    rig.tick(target(**{part: wrong}))
    assert rig.now is DriveState.HOLD
    assert all(map(isfinite, rig.command.angle_rad))


@pytest.mark.parametrize(
    ("reading", "word"),
    [
        (DriveReading(0.0, (nan, 0.3, 0.0, 0.6), ZERO, ZERO), "not usable"),
        (DriveReading(0.0, AT_REST[:3], ZERO, ZERO), "not usable"),
        (DriveReading(0.0, AT_REST, ZERO, ZERO, interaction_nm=(nan,) * 4), "not usable"),
        (DriveReading(0.0, AT_REST, (9.0, 0.0, 0.0, 0.0), ZERO), "plane was measured moving faster"),
        (DriveReading(0.0, (AT_REST[0], 2.5, *AT_REST[2:]), ZERO, ZERO), "elevation's measurement jumped"),
        (DriveReading(0.0, AT_REST, ZERO, (0.0, 0.0, 0.0, 40.0)), "elbow was measured using more torque"),
        (DriveReading(0.0, AT_REST, ZERO, ZERO, fault="The motor is hot."), "motor is hot"),
    ],
)
def test_sr2_a_measured_state_outside_its_limits_is_a_latched_fault(reading: DriveReading, word: str) -> None:
    rig = engaged(seconds=0.1)
    rig.tick(target(), reading=reading)
    assert rig.now is DriveState.FAULT
    assert word in rig.state.gate.reason
    assert all(map(isfinite, rig.command.angle_rad))
    rig.run(3.0, target())
    assert rig.now is DriveState.FAULT
    assert rig.wish(Reset(number=1)) == ""
    assert rig.now is DriveState.READY


def test_sr3_a_loop_that_stood_still_holds_until_a_person_resumes() -> None:
    rig = engaged(seconds=0.1)
    rig.t_s += 0.15
    rig.tick(target())
    assert rig.now is DriveState.HOLD
    assert "stood still" in rig.state.gate.reason
    rig.run(1.0, target())
    assert rig.now is DriveState.HOLD
    assert rig.wish(Resume(number=1)) == ""


def test_sr4_evidence_older_than_two_frames_slows_and_older_than_three_holds() -> None:
    rig = engaged(target(moved(0.0, 0.5, 0.0, 0.0)), seconds=0.8)
    slow = 0.2 * LIMITS[1].velocity_rad_s
    assert abs(rig.command.velocity_rad_s[1]) > slow
    rig.run(0.1, target(moved(0.0, 0.5, 0.0, 0.0)), age_s=0.095)
    assert rig.now is DriveState.ENGAGED
    assert abs(rig.command.velocity_rad_s[1]) < slow
    rig.tick(target(), age_s=0.101)
    assert rig.now is DriveState.HOLD
    rig.run(0.5, target(), age_s=0.5)
    assert rig.command.velocity_rad_s == ZERO
    assert rig.command.mode is DriveMode.HOLD


def test_sr4_a_grown_bound_slows_the_joint_it_belongs_to_and_then_holds_it_alone() -> None:
    wanted = target(moved(0.3, 0.3, 0.3, 0.4))
    rig = engaged(wanted, seconds=0.5)
    unsure = replace(wanted, bound_rad=(0.1, 0.1, 0.8, 0.1))
    rig.run(0.5, unsure)
    held = rig.command.angle_rad[2]
    rig.run(1.0, unsure)
    assert rig.command.angle_rad[2] == pytest.approx(held, abs=1e-3)
    assert rig.now is DriveState.ENGAGED
    rig.run(2.0, unsure)
    assert rig.command.angle_rad[3] == pytest.approx(AT_REST[3] + 0.4, abs=0.01)
    assert any(words.startswith("rotation: held") for words in rig.command.clamped)


def test_sr4_a_swing_that_stays_uncertain_holds_the_arm() -> None:
    rig = engaged(seconds=0.1)
    unsure = target(bound_rad=(0.8, 0.8, 0.1, 0.1))
    rig.run(CONFIG.resume_within_s - 0.1, unsure)
    assert rig.now is DriveState.ENGAGED
    rig.run(0.2, unsure)
    assert rig.now is DriveState.HOLD


def test_sr4_an_elbow_that_stays_uncertain_is_held_alone() -> None:
    wanted = target(moved(0.0, 0.3, 0.0, 0.4), bound_rad=(0.1, 0.1, 0.1, 0.9))
    rig = engaged(wanted, seconds=4.0)
    assert rig.now is DriveState.ENGAGED
    assert rig.command.angle_rad[3] == pytest.approx(AT_REST[3], abs=0.02)
    assert rig.command.angle_rad[1] == pytest.approx(AT_REST[1] + 0.3, abs=0.02)


def test_sr4_a_joint_that_was_held_comes_back_slowly() -> None:
    rig = engaged(seconds=2.1)
    unsure = target(moved(0.0, 0.0, 0.0, 0.8), bound_rad=(0.1, 0.1, 0.1, 0.9))
    rig.run(0.5, unsure)
    rig.run(0.2, target(moved(0.0, 0.0, 0.0, 0.8)))
    assert abs(rig.command.velocity_rad_s[3]) < 0.2 * LIMITS[3].velocity_rad_s


def test_sr5_a_short_loss_is_resumed_through_a_new_blend_in() -> None:
    rig = engaged(seconds=2.5)
    assert rig.state.blend == 1.0
    rig.run(0.5, None, age_s=0.2)
    assert rig.now is DriveState.HOLD
    rig.run(0.05, target())
    assert rig.now is DriveState.ENGAGED
    assert rig.state.blend < 0.05


def test_sr5_a_short_loss_is_not_resumed_before_the_arm_has_come_to_rest() -> None:
    rig = engaged(target(moved(0.0, 0.8, 0.0, 0.0)), seconds=0.9)
    rig.tick(None, age_s=0.2)
    ticks = 0
    while not rig.state.at_rest:
        rig.tick(target(rig.command.angle_rad))
        assert rig.now is DriveState.HOLD
        ticks += 1
    assert ticks > 3
    rig.tick(target(rig.command.angle_rad))
    assert rig.now is DriveState.ENGAGED


def test_sr2_a_late_tick_moves_no_set_point_further_than_two_ticks_may() -> None:
    rig = engaged(target(moved(0.0, 0.8, 0.0, 0.0)), seconds=0.9)
    before = rig.state.motions[1]
    rig.t_s += 0.08
    rig.tick(target(moved(0.0, 0.8, 0.0, 0.0)))
    assert rig.now is DriveState.ENGAGED
    assert 0.0 < rig.state.motions[1].angle_rad - before.angle_rad <= 2 * DT_S * LIMITS[1].velocity_rad_s
    assert rig.state.motions[1].angle_rad - before.angle_rad < 3 * DT_S * before.velocity_rad_s


def test_sr5_a_short_loss_is_not_resumed_where_the_target_has_gone_far() -> None:
    rig = engaged(seconds=0.5)
    rig.run(0.5, None, age_s=0.2)
    rig.run(3.0, target((*AT_REST[:3], AT_REST[3] + CONFIG.resume_within_rad + 0.1)))
    assert rig.now is DriveState.HOLD


def test_sr6_the_first_set_point_is_the_measured_position_and_the_step_takes_two_seconds() -> None:
    wanted = target(moved(0.0, 0.0, 0.0, 0.8))
    rig = Rig()
    rig.run(0.05, wanted)
    assert rig.wish(Enable(number=1)) == ""
    rig.tick(wanted)
    assert rig.command.angle_rad == pytest.approx(rig.reading.angle_rad, abs=1e-3)
    course = []
    while rig.state.blend < 1.0:
        course.append(rig.tick(wanted).angle_rad[3])
    assert len(course) * DT_S >= 2.0 - 2 * DT_S
    half_way = course[len(course) // 2]
    assert half_way == pytest.approx(AT_REST[3] + 0.4, abs=0.1)
    assert course == sorted(course)


def test_sr6_a_far_target_is_blended_in_for_longer() -> None:
    wanted = target(moved(0.0, 0.0, 0.0, 1.15))
    rig = Rig()
    rig.run(0.05, wanted)
    assert rig.wish(Enable(number=1)) == ""
    rig.tick(wanted)
    taken_s = 0.0
    while rig.state.blend < 1.0:
        rig.tick(wanted)
        taken_s += DT_S
    assert taken_s == pytest.approx(1.15 / CONFIG.blend_rad_s, abs=0.03)


def test_sr6_enable_is_refused_while_the_target_is_far_and_says_what_to_do() -> None:
    rig = Rig(config=msgspec.structs.replace(CONFIG, engage_within_rad=1.0))
    rig.run(0.05, target((*AT_REST[:3], AT_REST[3] + 1.1)))
    refusal = rig.wish(Enable(number=1))
    assert "too far" in refusal
    assert "elbow" in refusal
    assert "bring it near" in refusal
    rig.run(0.05, target())
    assert rig.wish(Enable(number=1)) == ""


def test_sr6_a_target_in_another_plane_is_not_far_for_a_hanging_arm() -> None:
    rig = Rig()
    rig.run(0.05, target((1.8, 0.25, *AT_REST[2:])))
    assert rig.wish(Enable(number=1)) == ""


@pytest.mark.parametrize("blocker", ["No session is open.", "The side was not confirmed."])
def test_sr10_what_the_session_lacks_forbids_enable(blocker: str) -> None:
    rig = Rig()
    rig.run(0.05, target(), blockers=(blocker,))
    assert blocker in rig.wish(Enable(number=1))
    assert rig.now is DriveState.READY


def test_sr10_an_arm_outside_the_patients_range_forbids_enable() -> None:
    rig = Rig()
    rig.run(0.05, target(), reading=DriveReading(0.0, (0.6, 2.3, 0.0, 0.6), ZERO, ZERO))
    assert "stands outside the patient's range" in rig.wish(Enable(number=1))


@pytest.mark.parametrize("then", ["stop", "silence"])
def test_sr7_sr9_a_stop_or_a_silent_service_brings_the_arm_to_rest_at_full_deceleration(
    then: str,
) -> None:
    wanted = target(moved(0.0, 0.8, 0.0, 0.0))
    rig = engaged(wanted, seconds=0.9)
    speed = abs(rig.command.velocity_rad_s[1])
    assert speed > 0.4
    if then == "stop":
        assert rig.wish(Stop(number=1, reason="pain")) == ""
    ticks = 0
    while any(rig.command.velocity_rad_s) or not ticks:
        rig.tick(wanted, service_age_s=0.3 if then == "silence" else 0.0)
        ticks += 1
    jerk_times_s = 2 * GateConfig().jerk_time_s  # the arm may have been speeding up
    assert ticks * DT_S <= speed / LIMITS[1].acceleration_rad_s2 + jerk_times_s + DT_S
    stayed = rig.command.angle_rad
    rig.run(2.0, wanted)
    assert rig.command.angle_rad == stayed
    assert rig.now is (DriveState.STOPPED if then == "stop" else DriveState.HOLD)


def test_sr5_resuming_waits_until_the_arm_has_come_to_rest() -> None:
    rig = engaged(target(moved(0.0, 0.8, 0.0, 0.0)), seconds=0.9)
    rig.tick(target(), service_age_s=0.3)
    rig.tick(target())
    assert "coming to rest" in rig.wish(Resume(number=1))


def test_an_arm_that_is_put_in_after_a_stop_is_not_pulled_to_where_the_last_one_lay() -> None:
    rig = engaged(target(moved(0.0, 0.6, 0.0, 0.6)), seconds=4.0)
    assert rig.wish(Stop(number=1, reason="pain")) == ""
    rig.run(0.5, target())
    rig.drive.fit(LIMITS)
    rig.state = safety.put_in(rig.state, rig.drive.read(rig.t_s), rig.t_s)
    rig.run(0.5, target())
    assert rig.command.angle_rad == pytest.approx(AT_REST, abs=1e-3)
    assert max(map(abs, rig.reading.velocity_rad_s)) < 0.1


def test_sr18_a_spastic_catch_of_the_simulated_arm_is_given_way_to_and_its_pull_falls_at_once() -> None:
    rig = Rig(drive=SimulatedDrive(STATION.exoskeleton, spasticity=Spasticity()))
    rig.run(0.05, target())
    assert rig.wish(Enable(number=1)) == ""
    for tick in range(600):  # bent slowly, stretched quickly
        rig.tick(target(moved(0.0, 0.0, 0.0, min(0.003 * tick, 1.0))))
    pulls = []
    for tick in range(150):
        rig.tick(target(moved(0.0, 0.0, 0.0, max(1.0 - 0.014 * tick, -0.4))))
        pulls.append(rig.reading.interaction_nm[3])
        if rig.now is DriveState.HOLD:
            break
    caught = [nm > LIMITS[3].resistance_nm for nm in pulls]
    assert len(caught) - caught.index(True) == 3
    assert "The elbow resists" in rig.state.gate.reason
    rig.run(0.1, target())
    assert rig.reading.interaction_nm[3] < LIMITS[3].resistance_nm


def test_sr7_an_arm_that_waits_does_not_sink() -> None:
    rig = Rig()
    rig.run(20.0, target())
    assert rig.reading.angle_rad == pytest.approx(AT_REST, abs=0.02)


def test_an_arm_that_is_moved_by_hand_before_it_is_enabled_is_held_where_it_was_put() -> None:
    rig = Rig()
    rig.run(0.1, target())
    for elevation_rad in (0.5, 0.6, 0.7, 0.8, 0.9):
        rig.tick(target(), reading=DriveReading(0.0, (0.9, elevation_rad, 0.2, 1.0), ZERO, ZERO))
    assert rig.command.angle_rad[1] == 0.9


def test_sr5_from_off_nothing_but_opening_a_session_leads_on() -> None:
    rig = Rig(state=SafetyState())
    rig.run(0.5, target())
    assert rig.wish(Enable(number=1)) != ""
    assert rig.now is DriveState.OFF
