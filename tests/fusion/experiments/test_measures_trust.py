"""The catalogue's words of trust are those that the recordings with truth lead to."""

from __future__ import annotations

import pytest

from fusion.experiments.catalogue import measures_trust
from fusion.experiments.measures.agreement import camera_error
from fusion.experiments.shelf import Shelf
from fusion.metrics.catalogue import MEASURES


@pytest.mark.recordings
@pytest.mark.parametrize("together", [True, False], ids=["two cameras", "one camera"])
def test_every_word_of_trust_follows_from_the_recordings(recordings, together) -> None:
    known = Shelf(recordings).recordings(measures_trust.TRUTHS)
    told = measures_trust.told_of(known, together=together)
    words = measures_trust.words(told, together=together)
    assert {word.name for word in words} == set(measures_trust.COMPARED)
    assert [word for word in words if word.said is not word.due] == []
    if together:
        found = {name: camera_error(name, told) for name in measures_trust.COMPARED}
        assert found == pytest.approx({name: MEASURES[name].camera_error for name in found}, rel=0.03, abs=1e-3)
