"""Scales that a person scores: their ranges, and what change in them is more than chance, or matters to patients."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

from fusion.metrics.measure import PublishedChange

PAGE = "Page, Fulk, Boyne, Phys Ther 92:791–798, 2012"
LANG = "Lang et al., Arch Phys Med Rehabil 89:1693–1700, 2008"


@dataclass(frozen=True, slots=True)
class Scale:
    """One scale; higher is better on all of them."""

    kind: str
    """As in the patient's scores."""
    name: str
    unit: str
    lowest: int
    highest: int
    source: str
    mdc: PublishedChange | None
    """The smallest change that is more than the error of measurement (95 %); None where none is known to us."""
    mcid: tuple[PublishedChange, ...] = ()
    """The smallest change that mattered to patients or therapists, by who they were."""


_ALL: Final = (
    Scale(
        kind="fugl-meyer-ue",
        name="Fugl-Meyer Assessment, upper extremity (motor)",
        unit="points",
        lowest=0,
        highest=66,
        source="Fugl-Meyer et al., Scand J Rehabil Med 7:13–31, 1975",
        mdc=PublishedChange(
            6.82,
            "Sensitivity to change and responsiveness of the FMA-UE, Neurorehabil Neural Repair 37:545–553, 2023",
            "moderate to severe, first six weeks (n = 51)",
        ),
        mcid=(
            PublishedChange(4.25, PAGE, "chronic, minimal to moderate; 4.25 to 7.25 by what is judged"),
            PublishedChange(9.0, "Top Stroke Rehabil 18 suppl 1:599–610, 2011", "subacute; 9 to 10"),
        ),
    ),
    Scale(
        kind="arat",
        name="Action Research Arm Test",
        unit="points",
        lowest=0,
        highest=57,
        source="Lyle, Int J Rehabil Res 4:483–492, 1981",
        mdc=None,
        mcid=(
            PublishedChange(5.7, "van der Lee et al., J Rehabil Med 33:110–113, 2001", "chronic: a tenth of the scale"),
            PublishedChange(12.0, LANG, "first weeks, dominant arm affected"),
            PublishedChange(17.0, LANG, "first weeks, other arm affected"),
        ),
    ),
    Scale(
        kind="box-and-block",
        name="Box and Block Test",
        unit="blocks per minute",
        lowest=0,
        highest=150,
        source="Mathiowetz et al., Am J Occup Ther 39:386–391, 1985",
        mdc=PublishedChange(
            5.5, "Chen et al., Neurorehabil Neural Repair 23:435–440, 2009", "the more affected hand; 7.8 the other"
        ),
    ),
)
SCALES: Final[Mapping[str, Scale]] = MappingProxyType({scale.kind: scale for scale in _ALL})
