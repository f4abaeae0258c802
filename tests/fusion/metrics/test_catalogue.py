"""The catalogue holds every figure that is computed, each said completely, in both languages."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from fusion.metrics.catalogue import MEASURES
from fusion.metrics.measure import Measure
from fusion.metrics.scales import SCALES

ROOT = Path(__file__).parents[3]
FAMILIES = ROOT / "fusion" / "metrics"
STRINGS = [ROOT / "web" / "src" / "strings" / language / "metrics.ts" for language in ("en", "zh")]
CAVEAT = re.compile(r'"(caveat\.\w+)"')


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
