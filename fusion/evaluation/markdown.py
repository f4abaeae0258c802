"""An evaluation as a page of Markdown, so that the results in the documentation can be made again."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from fusion.evaluation.runs import SETTLE_S, Evaluation, Run, Way, pooled
from fusion.evaluation.scores import Score

HEADINGS = ("rms", "mean", "std", "p50", "p95", "max", "inside", "bound p50", "lost")


def page(evaluations: Sequence[Evaluation], command: str) -> str:
    """Everything: the healthy arm pooled, per recording, and every joint.

    Args:
        evaluations: one per recording.
        command: what makes this page again.
    """
    parts = [_head(command), "## All recordings together", "Healthy arm (shoulder, elbow, wrist)."]
    parts += _ways(pooled(evaluations).items())
    for evaluation in evaluations:
        parts += [f"## {evaluation.recording}", f"Healthy arm: {evaluation.healthy_side.value}."]
        parts += _ways((run.way, run.healthy_arm) for run in evaluation.runs)
        parts += [_joints(run) for run in evaluation.runs[:1]]
    return "\n\n".join(parts) + "\n"


def cells(score: Score) -> tuple[str, ...]:
    """A score as text, in the order of `HEADINGS`."""
    lengths = (score.rms_mm, score.mean_mm, score.std_mm, score.p50_mm, score.p95_mm, score.max_mm)
    inside = f"{score.inside_share:.2%}"
    return (*(f"{mm:.1f}" for mm in lengths), inside, f"{score.bound_p50_mm:.0f}", str(score.frames_lost))


def title(causal: bool) -> str:
    """What is said of the alignment above a table."""
    return "Alignment learnt on the way, as live" if causal else "Alignment and clock from the whole recording first"


def _head(command: str) -> str:
    return (
        "# Results\n\n"
        f"Made by `{command}`; do not edit by hand.\n\n"
        "Distances from the fused joint to the truth in millimetres, on the 30 Hz grid, "
        f"everything after the first {SETTLE_S:g} s included: occluded, lost and held frames too. "
        "Mounting and clock offset of every sensor are estimated. *Inside*: share of instants at which the truth is no "
        "further from the point than the reported bound. *Lost*: instants with state 0. "
        "A sensor alone is its own latest sample, held where it sees nothing. "
        "What the columns rest on and why the rows differ: [estimation](estimation.md)."
    )


def _ways(scores: Iterable[tuple[Way, Score]]) -> list[str]:
    scores = list(scores)
    tables = []
    for causal in (False, True):
        rows = [(way.name, *cells(score)) for way, score in scores if way.causal == causal]
        if rows:
            tables += [f"{title(causal)}:", _table("method", rows)]
    return tables


def _joints(run: Run) -> str:
    """Every joint of one run, folded away."""
    rows = [(name, *cells(score)) for name, score in run.joints.items()]
    summary = f"<details><summary>Every joint, {run.way.name}</summary>"
    return f"{summary}\n\n{_table('joint', rows)}\n\n</details>"


def _table(first: str, rows: Iterable[Sequence[str]]) -> str:
    lines = [(first, *HEADINGS), ("---", *("---:" for _ in HEADINGS)), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)
