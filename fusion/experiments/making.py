"""Runs experiments one after another and draws their pictures."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from time import perf_counter

from fusion.experiments.experiment import Experiment, Setup
from fusion.experiments.house_style import rendered
from fusion.experiments.outcome import Outcome
from fusion.experiments.output.made import Made

Watch = Callable[[Experiment, float], None]
"""Told the experiment under way and the share of it that is done."""


def made(chosen: Sequence[Experiment], setup: Setup, watch: Watch = lambda experiment, share: None) -> Iterator[Made]:
    """Make each experiment; one that needs recordings nobody gave says so and is left out."""
    for experiment in chosen:
        yield _made(experiment, setup, watch)


def _made(experiment: Experiment, setup: Setup, watch: Watch) -> Made:
    started = perf_counter()
    watch(experiment, 0.0)
    if experiment.needs and not setup.has(experiment.needs):
        said = f"it needs real recordings called '{experiment.needs}'; give their folder with --recordings."
        return Made(experiment, Outcome(left_out=(said,)), 0.0, {})
    outcome = experiment.run(replace(setup, progress=lambda share: watch(experiment, share)))
    pictures = {picture.name: rendered(picture) for picture in outcome.pictures}
    return Made(experiment, outcome, perf_counter() - started, pictures)
