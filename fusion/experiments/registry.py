"""All experiments by name: every file in a catalogue is one."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from pkgutil import iter_modules
from types import ModuleType

from fusion.errors import InputError
from fusion.experiments import catalogue
from fusion.experiments.experiment import Experiment


def experiments(*more: ModuleType) -> dict[str, Experiment]:
    """Every experiment, chapter by chapter.

    Args:
        more: packages beside this one's catalogue, such as one whose experiments need more than fusion.
    """
    found = [each for package in (catalogue, *more) for each in _in(package)]
    return {each.name: each for each in sorted(found, key=lambda each: (each.chapter, each.order, each.name))}


def _in(package: ModuleType) -> list[Experiment]:
    names = [module.name for module in iter_modules(package.__path__)]
    return [import_module(f"{package.__name__}.{name}").EXPERIMENT for name in names]


def chosen(known: dict[str, Experiment], names: Sequence[str]) -> tuple[Experiment, ...]:
    """The named experiments in the order of the page; without names all that are made every day.

    Raises:
        InputError: a name is not known.
    """
    for name in names:
        if name not in known:
            raise InputError(f"no experiment is called '{name}'", f"one of {', '.join(known)}", "mend the name")
    return tuple(each for each in known.values() if each.name in names or (not names and not each.only_by_name))
