"""An evaluation as a page of Markdown, so that the results in the documentation can be made again."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import degrees, isnan

from fusion.evaluation.angle_scores import HOLD_FROM_RAD, SLOW_FROM_RAD, AngleScore
from fusion.evaluation.runs import SETTLE_S, Evaluation, Run, Way, pooled, pooled_angles
from fusion.evaluation.scores import Score

HEADINGS = ("rms", "mean", "std", "p50", "p95", "max", "inside", "bound p50", "lost")
ANGLE_HEADINGS = ("rms", "p95", "max", "inside", "bound", "engaged", "full", "engaged*", "full*")
ANGLE_LEGEND = (
    "Degrees, against the angles of the true joints in their own trunk frame. *Inside*: share of instants at which the "
    "true angle is within its bound; *bound*: its median. *Engaged*: share of instants with a bound below "
    f"{HOLD_FROM_RAD:g} rad, where a robot is not held; *full*: below {SLOW_FROM_RAD:g} rad, full speed; both outside "
    "the trouble that the recording knows of, and with an asterisk within it. The twist counts while the true elbow is "
    "bent by more than 45°."
)


def page(evaluations: Sequence[Evaluation], command: str) -> str:
    """Everything: the healthy arm pooled, per recording, and every joint.

    Args:
        evaluations: one per recording.
        command: what makes this page again.
    """
    parts = [_head(command), "## All recordings together", "Healthy arm (shoulder, elbow, wrist)."]
    parts += _ways(pooled(evaluations).items())
    parts += ["Angles of the healthy arm.", ANGLE_LEGEND, *_angles(pooled_angles(evaluations).items())]
    for evaluation in evaluations:
        parts += [f"## {evaluation.recording}", f"Healthy arm: {evaluation.healthy_side.value}."]
        parts += _ways((run.way, run.healthy_arm) for run in evaluation.runs)
        parts += [part for run in evaluation.runs[:1] for part in (*_angles([(run.way, run.angles)]), _joints(run))]
    return "\n\n".join(parts) + "\n"


def cells(score: Score) -> tuple[str, ...]:
    """A score as text, in the order of `HEADINGS`."""
    lengths = (score.rms_mm, score.mean_mm, score.std_mm, score.p50_mm, score.p95_mm, score.max_mm)
    inside = f"{score.inside_share:.2%}"
    return (*(f"{mm:.1f}" for mm in lengths), inside, f"{score.bound_p50_mm:.0f}", str(score.frames_lost))


def angle_cells(score: AngleScore) -> tuple[str, ...]:
    """A score as text, in the order of `ANGLE_HEADINGS`."""
    angles = (score.rms_rad, score.p95_rad, score.max_rad)
    shares = (score.clear.engaged, score.clear.full_speed, score.planted.engaged, score.planted.full_speed)
    return (
        *(f"{degrees(angle):.1f}" for angle in angles),
        f"{score.inside_share:.2%}",
        f"{degrees(score.bound_p50_rad):.0f}",
        *("–" if isnan(share) else f"{share:.1%}" for share in shares),
    )


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


def _angles(scores: Iterable[tuple[Way, dict[str, AngleScore]]]) -> list[str]:
    scores = list(scores)
    tables = []
    for causal in (False, True):
        ways = [(way, found) for way, found in scores if way.causal == causal]
        rows = [(f"{way.name}: {name}", *angle_cells(score)) for way, found in ways for name, score in found.items()]
        if rows:
            tables += [f"{title(causal)}:", _table("angle", rows, ANGLE_HEADINGS)]
    return tables


def _joints(run: Run) -> str:
    """Every joint of one run, folded away."""
    rows = [(name, *cells(score)) for name, score in run.joints.items()]
    summary = f"<details><summary>Every joint, {run.way.name}</summary>"
    return f"{summary}\n\n{_table('joint', rows)}\n\n</details>"


def _table(first: str, rows: Iterable[Sequence[str]], headings: Sequence[str] = HEADINGS) -> str:
    lines = [(first, *headings), ("---", *("---:" for _ in headings)), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)
