"""The catalogue's words of trust are those that the recordings with truth lead to."""

from __future__ import annotations

import pytest

from fusion.experiments.catalogue import measures_trust
from fusion.experiments.shelf import Shelf


@pytest.mark.recordings
@pytest.mark.parametrize("together", [True, False], ids=["two cameras", "one camera"])
def test_every_word_of_trust_follows_from_the_recordings(recordings, together) -> None:
    known = Shelf(recordings).recordings(measures_trust.TRUTHS)
    words = measures_trust.words(measures_trust.told_of(known, together=together), together=together)
    assert {word.name for word in words} == set(measures_trust.COMPARED)
    assert [word for word in words if word.said is not word.due] == []
