"""The station's own experiments are found beside those of fusion, and each says what it does."""

from __future__ import annotations

from fusion.experiments import registry
from fusion.experiments.experiment import CHAPTER_TITLES
from server.experiments import catalogue


def test_they_are_found_beside_the_others_and_say_what_they_do():
    alone, together = registry.experiments(), registry.experiments(catalogue)
    assert set(alone) <= set(together)
    for name, each in together.items():
        assert each.name == name
        assert each.chapter in CHAPTER_TITLES
        assert min(len(each.done), len(each.paper), len(each.title)) > 10
