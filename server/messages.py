"""What the service and the station say to one another, and what the browser is shown.

Wishes go in (`Wish`), ticks and events come out (`LiveTick`, `StationEvent`). Encoded with msgspec: msgpack between
the processes, JSON to the browser, whose TypeScript types are generated from these structs.
Units: metres, radians, seconds. Points are [x, y, z]; a missing point is null. Frames are in the names.
"""

from __future__ import annotations

from enum import StrEnum

import msgspec

from fusion.skeleton import Side

EXO_JOINTS: tuple[str, ...] = ("plane", "elevation", "rotation", "elbow")
"""The joints that limits, commands and measurements refer to: the shoulder's swing from the hanging arm as plane
(0 = sideways, +90° = ahead) and elevation, the humerus' rotation after that swing (internal +), and elbow flexion."""

Point = tuple[float, float, float]


class DriveState(StrEnum):
    """States of the safety gate (SR-5)."""

    OFF = "off"
    READY = "ready"
    ENGAGED = "engaged"
    HOLD = "hold"
    FAULT = "fault"
    STOPPED = "stopped"


# ---------------------------------------------------------------- limits


class JointLimits(msgspec.Struct, frozen=True, kw_only=True):
    """What one exoskeleton joint may do for this patient."""

    joint: str
    min_rad: float
    max_rad: float
    velocity_rad_s: float
    acceleration_rad_s2: float
    torque_nm: float = 15.0
    """The most that the drive may use beyond carrying the arm (SR-2)."""
    resistance_nm: float = 6.0
    """Where the arm resists with more, the drive holds softly at once (SR-18)."""


class Assistance(StrEnum):
    """How much of the movement is the drive's."""

    PASSIVE = "passive"
    """The drive moves the arm as the healthy one moves."""
    ASSISTED = "assisted"
    """The patient moves; the drive helps as much as is needed, and less where the patient needs less."""
    FREE = "free"
    """The drive carries the arm's weight, keeps it inside its limits, and only measures."""


# ---------------------------------------------------------------- wishes: service → station


class Wish(msgspec.Struct, frozen=True, kw_only=True, tag_field="kind"):
    """Something a person wants; read at the head of a tick, answered by a `WishAnswer` of the same number."""

    number: int


class OpenSession(Wish, frozen=True, kw_only=True, tag="open"):
    """Prepare for a patient. Motion stays impossible until `Enable`."""

    session: str
    patient: str
    """A name or pseudonym; never empty (SR-10)."""
    healthy_side: Side
    side_confirmed: bool
    limits: tuple[JointLimits, ...]
    limits_set_by: str
    """Account that set the limits (SR-10)."""
    recording: str
    """File to record to."""
    assistance: Assistance = Assistance.PASSIVE
    level: float = 1.0
    """0..1: the most help that `Assistance.ASSISTED` may give."""


class CloseSession(Wish, frozen=True, kw_only=True, tag="close"):
    """Ramp to rest, then let go of the patient and finish the recording."""


class Enable(Wish, frozen=True, kw_only=True, tag="enable"):
    """ready → engaged, through a blend-in (SR-6)."""


class Hold(Wish, frozen=True, kw_only=True, tag="hold"):
    """engaged → hold."""

    reason: str


class Resume(Wish, frozen=True, kw_only=True, tag="resume"):
    """hold → engaged, through a blend-in."""


class Stop(Wish, frozen=True, kw_only=True, tag="stop"):
    """Any → stopped, latched. Travels on a channel of its own."""

    reason: str


class Reset(Wish, frozen=True, kw_only=True, tag="reset"):
    """stopped or fault → ready (or off). A separate `Enable` is still needed."""


class Pain(Wish, frozen=True, kw_only=True, tag="pain"):
    """It hurts: engaged or hold → hold, softly, and only a person resumes (SR-18). Travels beside `Stop`."""

    reason: str


class SetAssistance(Wish, frozen=True, kw_only=True, tag="assist"):
    """Another way of helping, or more or less help, from now on."""

    mode: Assistance
    level: float
    """0..1: the most help that `Assistance.ASSISTED` may give."""


class FollowBody(Wish, frozen=True, kw_only=True, tag="follow"):
    """A person says which body of a sensor is the patient."""

    sensor: str
    body: str


class Heartbeat(Wish, frozen=True, kw_only=True, tag="heartbeat"):
    """The service is alive; without one for 250 ms the station holds. Not answered."""

    ticks_missed: int = 0
    """Ticks that the service never saw because a newer one replaced them (`Timing.ticks_dropped`)."""
    authority: str = ""
    """The account that is in charge and connected; "" = nobody, and an engaged arm holds (SR-11)."""


AnyWish = (
    OpenSession | CloseSession | Enable | Hold | Resume | Stop | Pain | Reset | SetAssistance | FollowBody | Heartbeat
)


class DemoGoal(msgspec.Struct, frozen=True, kw_only=True):
    """Where the demonstration's virtual patient should reach now; not a wish, and never part of a real session."""

    hand_in_trunk: Point | None
    """Where the *healthy* hand should go, in the patient's trunk frame; None = rest."""
    healthy_side: Side = Side.RIGHT
    exo_rad: tuple[float, ...] = ()
    """The exoskeleton's measured angles (`EXO_JOINTS`): the affected arm is where it holds it."""


# ---------------------------------------------------------------- events: station → service


class StationEvent(msgspec.Struct, frozen=True, kw_only=True, tag_field="kind"):
    """Something that happened and must not be lost; bounded queue, in order."""

    t_s: float


class WishAnswer(StationEvent, frozen=True, kw_only=True, tag="answer"):
    """What became of a wish. `reason` is a sentence for the person where it was refused."""

    number: int
    accepted: bool
    reason: str
    state: DriveState


class StateChanged(StationEvent, frozen=True, kw_only=True, tag="state"):
    """The safety gate changed its state."""

    before: DriveState
    after: DriveState
    reason: str


class Warned(StationEvent, frozen=True, kw_only=True, tag="warning"):
    """Something a person should know: a mirrored sender, a garbage flood, an overrun."""

    code: str
    text: str


class StationUp(StationEvent, frozen=True, kw_only=True, tag="up"):
    """The station is listening; where."""

    ports: dict[str, int]
    """Dialect (or "any") to UDP port."""
    drive: str
    real_time: bool = False
    """Whether the system granted real-time priority; without it, other programs make the loop late."""


class SessionClosed(StationEvent, frozen=True, kw_only=True, tag="closed"):
    """The recording is finished."""

    session: str
    recording: str


AnyEvent = WishAnswer | StateChanged | Warned | StationUp | SessionClosed


# ---------------------------------------------------------------- ticks: station → service → browser


class SensorView(msgspec.Struct, frozen=True, kw_only=True):
    """One sensor as the therapist sees it."""

    sensor: str
    dialect: str
    is_reference: bool
    frames_per_s: float
    latency_s: float
    joints_tracked: int
    clock_offset_s: float
    residual_m: float | None
    aligned: bool
    age_s: float
    """Time since its last frame."""
    refused_joints: int
    warnings: tuple[str, ...]
    position_in_room: Point | None
    joints_in_room: tuple[Point | None, ...]
    """25 joints after alignment; empty while unaligned."""


class PersonView(msgspec.Struct, frozen=True, kw_only=True):
    """A body that a sensor sees, for the therapist to say who the patient is."""

    sensor: str
    body: str
    """The sensor's own number for it."""
    place_in_sensor: Point
    """Middle of the trunk."""
    place_in_room: Point | None
    """The same, where the sensor's place is known."""
    is_patient: bool
    confirmed: bool
    """Whether a person said that this is the patient."""
    reason: str
    """What the body is taken for, in plain words."""


class BodyView(msgspec.Struct, frozen=True, kw_only=True):
    """The fused body."""

    joints_in_room: tuple[Point | None, ...]  # 25
    bound_m: tuple[float, ...]  # 25
    shape_m2: tuple[tuple[float, ...], ...]  # 25 x (xx, xy, xz, yy, yz, zz)
    state: tuple[int, ...]  # 25


class ArmView(msgspec.Struct, frozen=True, kw_only=True):
    """An arm's angles and its points; `points_in_trunk` are shoulder, elbow, wrist, hand in the patient's trunk
    frame (x to the patient's right, y up, z from chest to back: three.js's camera axes).
    """

    plane_rad: float
    elevation_rad: float
    rotation_rad: float
    elbow_rad: float
    plane_of_elevation_rad: float | None = None
    axial_rotation_rad: float | None = None
    alpha_rad: float | None = None
    beta_rad: float | None = None
    gamma_rad: float | None = None
    valid: bool
    points_in_trunk: tuple[Point, Point, Point, Point]
    points_in_room: tuple[Point, Point, Point, Point] | None


class ExoView(msgspec.Struct, frozen=True, kw_only=True):
    """The exoskeleton: measured against commanded, per joint of `EXO_JOINTS`."""

    angle_rad: tuple[float, ...]
    velocity_rad_s: tuple[float, ...]
    torque_nm: tuple[float, ...]
    command_rad: tuple[float, ...]
    command_velocity_rad_s: tuple[float, ...]
    clamped: tuple[str, ...]
    """What was clamped in this tick and why, in words."""
    speed_factor: float
    """1 = free, 0 = held by uncertainty; SR-4."""
    blend: float
    """0..1 of the blend-in after engage or resume; SR-6."""
    fault: str
    interaction_nm: tuple[float, ...] = ()
    """What the arm adds to its expected weight; + pushes towards larger angles. Older recordings have none."""
    share: tuple[float, ...] = ()
    """0..1 per joint: how much of the drive's stiffness helps now."""
    assistance: Assistance = Assistance.PASSIVE
    level: float = 1.0
    """0..1: the most help that `Assistance.ASSISTED` may give."""
    compliant: bool = False
    """It holds softly: resistance, pain, or a joint whose stop category says so."""


class Timing(msgspec.Struct, frozen=True, kw_only=True):
    """How old things are."""

    datagram_to_command_s: float | None
    """Receive time of the newest datagram used in this tick → its command was given to the drive."""
    tick_s: float
    """Work in this tick."""
    overruns: int
    datagrams: int
    datagrams_refused: int
    ticks_dropped: int
    recorder_dropped: int


class LiveTick(msgspec.Struct, frozen=True, kw_only=True):
    """One tick of the station as it leaves at its tail."""

    index: int
    t_s: float
    """Monotonic time of the tick's head."""
    t_newest_received_s: float | None
    state: DriveState
    reason: str
    """Why the state is what it is, in plain words; "" when engaged and free."""
    may_enable: bool
    blockers: tuple[str, ...]
    """What still keeps `Enable` from being accepted, in plain words."""
    session: str
    authority: str = ""
    """The account that is in charge and connected; "" = nobody."""
    healthy_side: Side
    sensors: tuple[SensorView, ...]
    people: tuple[PersonView, ...] = ()
    """Every body in view of every sensor; ticks recorded before this was told have none."""
    body: BodyView | None
    healthy: ArmView | None
    target: ArmView | None
    """The mirrored arm (affected side)."""
    affected: ArmView
    """The affected arm as the exoskeleton measures it."""
    exo: ExoView
    limits: tuple[JointLimits, ...]
    trunk_lean_m: float
    """Displacement of SpineShoulder from where it was when the session was enabled."""
    shoulder_hitch_m: float = 0.0
    """Rise of the healthy shoulder along the spine since then, beyond what raising the arm brings with it."""
    timing: Timing
    warnings: tuple[str, ...]
