"""All outcomes as one page for a browser: it needs nothing beside it, reads well and prints well."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Sequence
from html import escape
from importlib.resources import files
from itertools import groupby

from fusion.experiments.experiment import CHAPTER_TITLES, Chapter
from fusion.experiments.outcome import Beside, Outcome, Picture, Table
from fusion.experiments.output.made import Made, Origin

VERDICTS = {True: '<span class="met">met</span>', False: '<span class="missed">missed</span>', None: ""}

HEADINGS = {False: ("What the paper has.", "Why they differ."), True: ("The goal.", "What to make of it.")}
"""What stands before a paper's figures and the reasons; for experiments of our own there is a goal instead."""


def page(made: Sequence[Made], origin: Origin) -> str:
    """The whole page as HTML."""
    style = files(__package__).joinpath("page.css").read_text(encoding="utf-8")
    body = "\n".join([_head(made, origin), _glance(made), *_chapters(made)])
    return (
        '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>mirrorlimb: the papers' experiments, made again</title>\n<style>\n{style}</style>\n</head>\n"
        f"<body>\n<main>\n{body}\n</main>\n</body>\n</html>\n"
    )


def _head(made: Sequence[Made], origin: Origin) -> str:
    with_recordings = "with real recordings" if origin.recordings else "without real recordings"
    minutes = sum(each.took_s for each in made) / 60
    return (
        "<header><h1>The papers' experiments, made again</h1>"
        f"<p>Made by <code>{escape(origin.command)}</code>, version {escape(origin.version)}, {with_recordings}, "
        f"seed {origin.seed}, in {minutes:.1f} minutes. With the same version, seed and recordings everything but "
        "measured times comes out the same. Nothing here is a claim about patients: this is research software, "
        "and most of it is measured on simulations, whose errors are simpler than real ones.</p></header>"
    )


def _glance(made: Sequence[Made]) -> str:
    rows = [
        [_link(each) if number == 0 else "", *_beside(row)]
        for each in made
        for number, row in enumerate(each.outcome.beside)
    ]
    grid = _grid(("experiment", "what", "paper, or goal", "ours", ""), rows, frozenset())
    return f'<section><h2>At a glance</h2><div class="glance">{grid}</div></section>'


def _link(made: Made) -> str:
    name = escape(made.experiment.name)
    return f'<a href="#{name}">{name}</a>'


def _beside(row: Beside) -> list[str]:
    return [escape(row.what), escape(row.paper), escape(row.ours), VERDICTS[row.met]]


def _chapters(made: Sequence[Made]) -> Iterable[str]:
    for chapter, group in groupby(made, key=lambda each: each.experiment.chapter):
        yield f"<h2>{escape(CHAPTER_TITLES[Chapter(chapter)])}</h2>"
        yield from (_section(each) for each in group)


def _section(made: Made) -> str:
    experiment, outcome = made.experiment, made.outcome
    asked, answered = HEADINGS[experiment.chapter is Chapter.OURS]
    parts = [
        f'<section id="{experiment.name}"><h3>{escape(experiment.title)}</h3>',
        f'<p class="command"><code>mirrorlimb experiments {experiment.name}</code> · {made.took_s:.0f} s</p>',
        f"<p><b>What was done.</b> {escape(experiment.done)}</p>",
        f"<p><b>{asked}</b> {escape(experiment.paper)}</p>",
        *(f'<p class="left-out">Left out: {escape(reason)}</p>' for reason in outcome.left_out),
        *(_figure(picture, made.pictures[picture.name]["svg"]) for picture in outcome.pictures),
        *(_table(table) for table in outcome.tables),
        f"<p><b>{answered}</b> {escape(outcome.why)}</p>" if outcome.why else "",
        _seeds(outcome),
    ]
    return "\n".join([*parts, "</section>"])


def _seeds(outcome: Outcome) -> str:
    return f'<p class="seeds">Seeds: {", ".join(map(str, outcome.seeds))}</p>' if outcome.seeds else ""


def _figure(picture: Picture, svg: bytes) -> str:
    source = f"data:image/svg+xml;base64,{b64encode(svg).decode()}"
    caption = escape(picture.caption)
    width = round(picture.width_in * 96)
    return f'<figure><img src="{source}" width="{width}" alt="{caption}"><figcaption>{caption}</figcaption></figure>'


def _table(table: Table) -> str:
    numbers = frozenset(k for k in range(len(table.columns)) if table.is_number(k))
    rows = [[escape(cell) for cell in row] for row in table.as_text()]
    grid = _grid([column.heading for column in table.columns], rows, numbers)
    caption = escape(table.caption)
    if table.folded:
        return f"<details><summary>{caption}</summary>{grid}</details>"
    return f'<div class="table"><p class="caption">{caption}</p>{grid}</div>'


def _grid(headings: Sequence[str], rows: Iterable[Sequence[str]], numbers: frozenset[int]) -> str:
    """A table; the cells of `rows` are HTML already."""

    def line(cells: Iterable[str], tag: str) -> str:
        marks = (' class="number"' if k in numbers else "" for k in range(len(headings)))
        return (
            "<tr>" + "".join(f"<{tag}{mark}>{cell}</{tag}>" for mark, cell in zip(marks, cells, strict=True)) + "</tr>"
        )

    head = line((escape(heading) for heading in headings), "th")
    body = "".join(line(row, "td") for row in rows)
    return f"<table><thead>{head}</thead><tbody>{body}</tbody></table>"
