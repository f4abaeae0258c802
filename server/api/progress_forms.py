"""Forms of what measures mean, and of how a patient's figures went over the sessions."""

from __future__ import annotations

from datetime import datetime

from pydantic import BaseModel, ConfigDict

from fusion.metrics.measure import Better, Trust
from fusion.metrics.progress import Verdict


class PublishedChangePublic(BaseModel):
    """A difference between two measurements that somebody has published."""

    model_config = ConfigDict(from_attributes=True)

    value: float
    source: str
    of_whom: str


class MeasurePublic(BaseModel):
    """What a figure means, and how far it can be trusted."""

    model_config = ConfigDict(from_attributes=True)

    name: str
    label_key: str
    """Of its name in the browser's strings; with ".means" behind it, of a sentence on it where there is one."""
    unit: str
    formula: str
    source: str
    filter: str
    trust: Trust
    """With two depth cameras or more, where it comes from them."""
    trust_of_one: Trust | None
    """With one depth camera alone; null = the same, since it does not come from cameras."""
    trust_key: str
    """Of the sentence that says why, in the browser's strings."""
    better: Better
    mdc: PublishedChangePublic | None
    """Null = not published for this sensor: it comes from the patient's own sessions."""
    mcid: PublishedChangePublic | None
    """The smallest change that mattered to patients; null = not published."""


class ScalePublic(BaseModel):
    """A scale that a person scores."""

    model_config = ConfigDict(from_attributes=True)

    kind: str
    name: str
    unit: str
    lowest: int
    highest: int
    source: str
    mdc: PublishedChangePublic | None
    mcid: list[PublishedChangePublic]


class ProgressPoint(BaseModel):
    """A figure in one session."""

    session_id: int
    at: datetime
    value: float
    sem: float | None
    """Standard error from within the session; null where it is not known, or where it is a plain count or time."""
    caveat: str
    """Key of what must be said beside it, or empty."""


class ProgressLine(BaseModel):
    """One figure over the patient's sessions, oldest first; sessions without it are left out."""

    name: str
    joint: str
    """Or the game, in a game's figures."""
    side: str
    label: str
    unit: str
    trust: Trust
    trust_key: str
    better: Better
    points: list[ProgressPoint]
    difference: float | None
    """The last session's minus the first's; null with fewer than two."""
    mdc: float | None
    """Minimal detectable change (95 %): a smaller difference between two sessions may be chance. Null = not known."""
    mdc_is_published: bool
    verdict: Verdict


class Progress(BaseModel):
    """How a patient's figures went."""

    sessions: int
    lines: list[ProgressLine]
    """In the order of the catalogue; sensors' and states' figures are left out."""

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {
                    "sessions": 1,
                    "lines": [
                        {
                            "name": "own_range",
                            "joint": "elbow",
                            "side": "left",
                            "label": "metric.own_range",
                            "unit": "rad",
                            "trust": "good",
                            "trust_key": "trust.encoder",
                            "better": "more",
                            "points": [
                                {
                                    "session_id": 3,
                                    "at": "2026-03-02T09:00:00Z",
                                    "value": 1.1,
                                    "sem": 0.03,
                                    "caveat": "",
                                }
                            ],
                            "difference": None,
                            "mdc": 0.083,
                            "mdc_is_published": False,
                            "verdict": "unknown",
                        }
                    ],
                }
            ]
        }
    )
