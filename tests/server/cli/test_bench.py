"""`mirrorlimb bench`: every figure it promises, and the two slips it answers."""

import json

from typer.testing import CliRunner

from fusion.errors import InputError
from fusion.estimation import METHODS
from server.cli.main import app


def test_every_method_stands_beside_both_baselines() -> None:
    result = CliRunner().invoke(app, ["bench", "--rounds", "1", "--length", "6", "--json"], catch_exceptions=False)
    figures = json.loads(result.stdout)
    assert [line["work"] for line in figures["fused_frame"]] == [*METHODS, "FilterPy", "Stone Soup"]
    assert figures["fused_frame"][0]["times_ours"] == 1.0
    assert all(line["median_us"] > 0 for part in ("fused_frame", "growth", "tick") for line in figures[part])
    assert list(figures["offline_times_real_time"]) == ["virtual-3"]


def test_what_cannot_be_timed_is_refused() -> None:
    for words in (["--rounds", "0"], ["--length", "1"]):
        assert isinstance(CliRunner().invoke(app, ["bench", *words]).exception, InputError)
