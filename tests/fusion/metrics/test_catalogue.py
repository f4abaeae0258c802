"""The catalogue holds every figure that is computed, each said completely, in both languages."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from fusion.metrics.catalogue import MEASURES
from fusion.metrics.definitions.session import ASKED_MEASURES
from fusion.metrics.measure import Measure
from fusion.metrics.record import Attempt, DriveTrack, SensorTrack, SessionRecord
from fusion.metrics.scales import SCALES
from fusion.metrics.session import session_metrics
from fusion.metrics.stretches import RATE_HZ
from fusion.skeleton import Side

ROOT = Path(__file__).parents[3]
FAMILIES = ROOT / "fusion" / "metrics"
STRINGS = [ROOT / "web" / "src" / "strings" / language / "metrics.ts" for language in ("en", "zh")]
CAVEAT = re.compile(r'"(caveat\.\w+)"')


def whole_session() -> SessionRecord:
    """Two minutes in which everything happens that can be measured."""
    t_s = np.arange(0.0, 120.0, 1 / RATE_HZ)
    ticks = len(t_s)
    sway = np.column_stack([1.0 + 0.5 * np.sin((1.3 + 0.1 * k) * t_s) for k in range(4)])
    hand = np.column_stack([0.2 * np.sin(2.0 * t_s), 0.1 * np.sin(2.0 * t_s), -0.4 + 0.1 * np.cos(2.0 * t_s)])
    states = np.array(["off", "ready", "hold", "fault", "stopped"])
    modes = np.array(["passive", "assisted", "free"])
    ones = np.ones((ticks, 4))
    return SessionRecord(
        t_s=t_s,
        state=np.where(t_s < 10.0, states[(t_s / 2.0).astype(int) % 5], "engaged"),
        healthy_side=Side.LEFT,
        healthy_rad=sway,
        healthy_valid=np.ones(ticks, dtype=bool),
        affected_rad=sway,
        hand_in_trunk=hand,
        trunk_displacement_m=np.full(ticks, 0.02),
        sensors=(SensorTrack("kinect-1", *(np.full(ticks, 30.0) for _ in range(3))),),
        hits=3,
        misses=1,
        drive=DriveTrack(
            np.cos(t_s)[:, None] * ones, 5 * ones, ones, 0.5 * ones, modes[(t_s / 40).astype(int)], ones[:, 0]
        ),
        shoulder_hitch_m=np.full(ticks, 0.01),
        attempts=(Attempt("reach", True, 0.4, 5.0, 0.4, 1.2, 1.3, 0.01, 0.01),),
    )


def test_the_catalogue_holds_exactly_what_is_computed_and_asked() -> None:
    computed = session_metrics(whole_session())
    asked = {measure.name for measure in ASKED_MEASURES}
    assert {metric.name for metric in computed} | asked == set(MEASURES)
    assert {(metric.name, metric.unit) for metric in computed if MEASURES[metric.name].unit != metric.unit} == set()
    assert {metric.label_key for metric in computed} <= {measure.label_key for measure in MEASURES.values()}


@pytest.mark.parametrize("measure", MEASURES.values(), ids=MEASURES)
def test_every_entry_is_said_completely(measure: Measure) -> None:
    assert measure.formula
    assert measure.source
    assert measure.unit in {"m", "s", "rad", "m/s", "Hz", "N m", "J", "min", "1"}
    assert measure.filter


@pytest.mark.parametrize("strings", STRINGS, ids=["en", "zh"])
def test_every_entry_can_be_shown(strings: Path) -> None:
    said = strings.read_text(encoding="utf-8")
    wanted = {key for each in MEASURES.values() for key in (each.label_key, each.trust_key)}
    wanted |= {caveat for path in FAMILIES.glob("*.py") for caveat in CAVEAT.findall(path.read_text(encoding="utf-8"))}
    assert not {key for key in wanted if f'"{key}":' not in said}


def test_scales_end_where_their_tests_do() -> None:
    assert {kind: (scale.lowest, scale.highest) for kind, scale in SCALES.items()} == {
        "fugl-meyer-ue": (0, 66),
        "arat": (0, 57),
        "box-and-block": (0, 150),
    }
    for scale in SCALES.values():
        for change in (*scale.mcid, *filter(None, [scale.mdc])):
            assert 0 < change.value < scale.highest / 2
            assert re.search(r"(19|20)\d\d", change.source)
