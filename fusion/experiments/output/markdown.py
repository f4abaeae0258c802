"""All outcomes as a page of the documentation: tables only, details folded."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from fusion.experiments.experiment import CHAPTER_TITLES
from fusion.experiments.outcome import Beside, Outcome, Table
from fusion.experiments.output.made import Made, Origin

VERDICTS = {True: "met", False: "missed", None: ""}


def markdown(made: Sequence[Made], origin: Origin) -> str:
    """The whole page."""
    parts = [_head(origin), "## At a glance", *_glance(made)]
    chapter = None
    for each in made:
        if each.experiment.chapter is not chapter:
            chapter = each.experiment.chapter
            parts.append(f"## {CHAPTER_TITLES[chapter]}")
        parts += _section(each)
    return "\n\n".join(parts) + "\n"


def _head(origin: Origin) -> str:
    return (
        "# Results\n\n"
        f"Made by `{origin.command}` (version {origin.version}, seed {origin.seed}); do not edit by hand. The same "
        "command writes every figure as PNG and SVG, every table as CSV, and one page that holds them all. "
        "What each experiment does and how to add one: [experiments](experiments.md)."
    )


def _glance(made: Sequence[Made]) -> list[str]:
    rows = [(each.experiment.name, *_beside(row)) for each in made for row in each.outcome.beside]
    return [_grid(("experiment", "what", "paper or goal", "ours", ""), rows, numbers=frozenset())]


def _beside(row: Beside) -> tuple[str, ...]:
    return row.what, row.paper, row.ours, VERDICTS[row.met]


def _section(made: Made) -> list[str]:
    experiment, outcome = made.experiment, made.outcome
    parts = [f"### {experiment.title}", f"`mirrorlimb experiments {experiment.name}`. {experiment.done}"]
    parts += [f"*{experiment.paper}*", *(f"Left out: {reason}" for reason in outcome.left_out)]
    parts += [part for table in outcome.tables for part in _table(table)]
    if outcome.why:
        parts.append(outcome.why)
    return parts + _seeds(outcome)


def _seeds(outcome: Outcome) -> list[str]:
    return [f"Seeds: {', '.join(map(str, outcome.seeds))}."] if outcome.seeds else []


def _table(table: Table) -> list[str]:
    numbers = frozenset(k for k in range(len(table.columns)) if table.is_number(k))
    grid = _grid([column.heading for column in table.columns], table.as_text(), numbers)
    if not table.folded:
        return [f"{table.caption}:", grid]
    return [f"<details><summary>{table.caption}</summary>\n\n{grid}\n\n</details>"]


def _grid(headings: Sequence[str], rows: Iterable[Sequence[str]], numbers: frozenset[int]) -> str:
    rules = ["---:" if k in numbers else "---" for k in range(len(headings))]
    lines = [headings, rules, *rows]
    return "\n".join(f"| {' | '.join(_escaped(cell) for cell in line)} |" for line in lines)


def _escaped(cell: str) -> str:
    return cell.replace("|", "\\|")
