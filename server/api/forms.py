"""What the REST interface takes and gives, besides the forms that mirror the tables in `db`."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, StringConstraints

from db.account import AccountPublic
from db.exercise import Exercise
from db.limits import AssistanceName, PassiveRange
from db.patient import PatientPublic, SideName
from db.therapy_session import LimitsSnapshot
from server.messages import Assistance, DriveState

Pain = Annotated[int, Field(ge=0, le=10)]
Number = Annotated[int, Field(ge=0, le=2**53 - 1)]
"""What names a patient, a session or a score: at most what a page holds exactly; the database holds more."""
NAME = "Dr. Lin"
PASSWORD_EXAMPLE = "three quiet herons"  # noqa: S105 (an example, opens nothing)


class Form(BaseModel):
    """What somebody sends; a word that is not asked for is refused."""

    model_config = ConfigDict(extra="forbid")


class Credentials(Form):
    """A name and a password."""

    name: Annotated[str, StringConstraints(min_length=1, max_length=80, strip_whitespace=True)]
    password: Annotated[str, StringConstraints(min_length=1, max_length=200)]

    model_config = ConfigDict(
        extra="forbid", json_schema_extra={"examples": [{"name": NAME, "password": PASSWORD_EXAMPLE}]}
    )


class NewCredentials(Credentials):
    """The first account's name and password."""

    password: Annotated[str, StringConstraints(min_length=10, max_length=200)]


class Status(BaseModel):
    """What a page needs to know before anybody has logged in."""

    version: str
    first_start: bool
    """There is no account yet: ask for the first one."""
    demo: bool
    """The demonstration may be entered from this browser."""
    account: AccountPublic | None
    """Who is logged in."""

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"version": "0.1.0", "first_start": False, "demo": True, "account": None}]}
    )


class DemoWelcome(BaseModel):
    """The demonstration's account and its patient."""

    account: AccountPublic
    patient: PatientPublic


class SessionOpen(Form):
    """Opening a session; the affected side is said once more so that a slip is found before the arm moves."""

    patient_id: Number
    confirmed_affected_side: SideName
    exercises: tuple[Exercise, ...] | None = Field(default=None, min_length=1, max_length=12)
    """Null = the patient's plan; without one, six minutes of reach."""
    pain_before: Pain | None = None
    assistance: AssistanceName | None = None
    """How the drive helps at first; null = as the patient's page says."""
    assist_level: float | None = Field(default=None, ge=0, le=1)
    """The most help while assisted; null = the most that the patient is allowed."""

    model_config = ConfigDict(
        extra="forbid",
        json_schema_extra={
            "examples": [
                {
                    "patient_id": 1,
                    "confirmed_affected_side": "left",
                    "exercises": [{"game": "reach", "minutes": 6.0, "level": 0.3, "pinned": False}],
                    "pain_before": 2,
                }
            ]
        },
    )


class SessionEnd(Form):
    """Ending a session."""

    pain_after: Pain | None = None

    model_config = ConfigDict(extra="forbid", json_schema_extra={"examples": [{"pain_after": 1}]})


Action = Literal["start", "hold", "resume", "stop", "reset", "pain"]


class Control(Form):
    """What a person wants of the arm."""

    action: Action

    model_config = ConfigDict(extra="forbid", json_schema_extra={"examples": [{"action": "start"}]})


class AssistanceForm(Form):
    """How the drive is to help from now on."""

    mode: Assistance
    level: float = Field(ge=0, le=1)
    """The most help while assisted."""

    model_config = ConfigDict(extra="forbid", json_schema_extra={"examples": [{"mode": "assisted", "level": 0.5}]})


class TakeOver(Form):
    """Taking over; while another page is in charge and connected, this must be confirmed."""

    confirmed: bool = False

    model_config = ConfigDict(extra="forbid", json_schema_extra={"examples": [{"confirmed": True}]})


class AuthorityPublic(BaseModel):
    """Who is in charge of the open session."""

    account: str
    client: str
    """What the page in charge calls itself."""
    connected: bool

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"account": NAME, "client": "3f1c9e", "connected": True}]}
    )


class MeasuredRange(BaseModel):
    """How far each joint was moved while the drive only carried the arm."""

    ticks: int
    range: PassiveRange | None
    """Null until every joint has moved."""

    model_config = ConfigDict(json_schema_extra={"examples": [{"ticks": 0, "range": None}]})


class Follow(Form):
    """Which body of a sensor is the patient."""

    sensor: str = Field(min_length=1, max_length=120)
    body: str = Field(min_length=1, max_length=60)

    model_config = ConfigDict(
        extra="forbid", json_schema_extra={"examples": [{"sensor": "127.0.0.1", "body": "72057594037944738"}]}
    )


class View3DShown(Form):
    """What the 3-D view shows besides the body and the exoskeleton."""

    sensors: bool
    """Every sensor's own skeleton, faintly."""
    bounds: bool
    """The set that holds each joint."""

    model_config = ConfigDict(extra="forbid", json_schema_extra={"examples": [{"sensors": True, "bounds": False}]})


class View3DColours(BaseModel):
    """What each colour of the 3-D view is, as #rrggbb."""

    fused: str
    mirrored: str
    exoskeleton: str
    bounds: str
    sensors: list[str]
    """In the order in which a tick names the sensors; begun again where there are more."""


class View3DLook(BaseModel):
    """How the 3-D view looks now."""

    shown: View3DShown
    colours: View3DColours


class Answer(BaseModel):
    """What the station made of an accepted wish."""

    state: DriveState
    reason: str

    model_config = ConfigDict(json_schema_extra={"examples": [{"state": "engaged", "reason": ""}]})


class JointCurves(BaseModel):
    """One arm's angles over time in radians; null where they could not be known."""

    plane: list[float | None]
    elevation: list[float | None]
    rotation: list[float | None]
    elbow: list[float | None]


class Curves(BaseModel):
    """A session's curves, thinned to at most 1500 points."""

    t_s: list[float]
    """Since the session's first tick."""
    healthy_rad: JointCurves
    affected_rad: JointCurves
    state: list[DriveState]

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {
                    "t_s": [0.0, 0.1],
                    "healthy_rad": {
                        "plane": [0.4, 0.4],
                        "elevation": [0.2, 0.3],
                        "rotation": [0.0, None],
                        "elbow": [0.5, 0.6],
                    },
                    "affected_rad": {
                        "plane": [0.4, 0.4],
                        "elevation": [0.1, 0.2],
                        "rotation": [0.0, 0.0],
                        "elbow": [0.4, 0.5],
                    },
                    "state": ["ready", "engaged"],
                }
            ]
        }
    )


class Percentiles(BaseModel):
    """A latency over its newest samples, in seconds; null while there are none."""

    p50_s: float | None
    p99_s: float | None
    samples: int


class Latencies(BaseModel):
    """How old things are."""

    datagram_to_command: Percentiles
    """Newest datagram in a tick received → its command given to the drive."""
    datagram_to_picture: Percentiles
    """Newest datagram in a tick received → the patient's screen says that it has drawn it."""
    datagram_to_dashboard: Percentiles
    """The same for the therapist's page."""


class Station(BaseModel):
    """The real-time side."""

    up: bool
    ports: dict[str, int]
    """Dialect, or "any", to UDP port."""
    drive: str
    simulated: bool
    state: DriveState
    reason: str
    restarts: int
    """How often the station has died and been started again."""
    latency: Latencies
    device: list[LimitsSnapshot]
    soft_margin_rad: float
    """Set-points keep this far inside a patient's limits."""

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {
                    "up": True,
                    "ports": {"kinectv2-osc": 12345},
                    "drive": "simulated",
                    "simulated": True,
                    "state": "off",
                    "reason": "no session is open",
                    "restarts": 0,
                    "latency": {
                        "datagram_to_command": {"p50_s": 0.006, "p99_s": 0.012, "samples": 1000},
                        "datagram_to_picture": {"p50_s": 0.04, "p99_s": 0.08, "samples": 1000},
                        "datagram_to_dashboard": {"p50_s": 0.05, "p99_s": 0.1, "samples": 1000},
                    },
                    "device": [
                        {
                            "joint": "elbow",
                            "min_rad": 0.0,
                            "max_rad": 2.4,
                            "velocity_rad_s": 1.5,
                            "acceleration_rad_s2": 6.0,
                            "torque_nm": 20.0,
                            "resistance_nm": 20.0,
                        }
                    ],
                    "soft_margin_rad": 0.1,
                }
            ]
        }
    )


class GamePublic(BaseModel):
    """A game that can be chosen."""

    name: str

    model_config = ConfigDict(json_schema_extra={"examples": [{"name": "reach"}]})
