"""The catalogue's words of trust are those that the recordings with truth lead to."""

from __future__ import annotations

import pytest

from fusion.experiments.catalogue import measures_trust
from fusion.experiments.shelf import Shelf


@pytest.mark.recordings
def test_every_word_of_trust_follows_from_the_recordings(recordings) -> None:
    known = Shelf(recordings).recordings(measures_trust.TRUTHS)
    two, one = (measures_trust.told_of(known, together=together) for together in (True, False))
    words = measures_trust.words_beside(two, one)
    assert {row.what.split(",")[0] for row in words} == set(measures_trust.COMPARED)
    assert [row.what for row in words if not row.met] == []
