"""A patient's figures, session by session, and what became of each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

from db.therapy_session import MetricBase, SessionDetail, SessionStatus
from fusion.metrics.catalogue import MEASURES
from fusion.metrics.definitions import session as of_session
from fusion.metrics.measure import Better, Measure
from fusion.metrics.progress import SessionValue, change_of
from server.api.progress_forms import Progress, ProgressLine, ProgressPoint

LEFT_OUT: Final = frozenset(
    measure.name for measure in of_session.MEASURES if measure.name.startswith(("time_", "sensor_"))
)
"""They are of a session, not of the patient."""
_Figure = tuple[str, str, str]  # name, joint, side


def progress_of(history: Sequence[SessionDetail]) -> Progress:
    """How every figure went.

    Args:
        history: the patient's sessions in any order; one that is open counts for nothing yet.
    """
    over = sorted((one for one in history if one.status is not SessionStatus.OPEN), key=lambda one: one.started_at)
    points: dict[_Figure, list[ProgressPoint]] = {}
    for one in over:
        for metric in (*one.metrics, *_asked(one)):
            if metric.value is not None and metric.name in MEASURES and metric.name not in LEFT_OUT:
                points.setdefault((metric.name, metric.joint, metric.side), []).append(
                    _point(one, metric, metric.value)
                )
    ordered = sorted(points, key=lambda figure: list(MEASURES).index(figure[0]))
    affected = over[-1].affected_side if over else ""
    return Progress(sessions=len(over), lines=[_line(figure, points[figure], affected) for figure in ordered])


def _asked(session: SessionDetail) -> list[MetricBase]:
    """The patient's pain, as figures."""
    said = (("pain_before", session.pain_before), ("pain_after", session.pain_after))
    return [MetricBase(name=name, value=float(pain)) for name, pain in said if pain is not None]


def _point(session: SessionDetail, metric: MetricBase, value: float) -> ProgressPoint:
    return ProgressPoint(
        session_id=session.id, at=session.started_at, value=value, sem=metric.sem, caveat=metric.caveat
    )


def _line(figure: _Figure, points: list[ProgressPoint], affected_side: str) -> ProgressLine:
    name, joint, side = figure
    measure = _of_side(MEASURES[name], side, affected_side)
    change = change_of(measure, [SessionValue(point.value, point.sem, point.caveat or None) for point in points])
    return ProgressLine(
        name=name,
        joint=joint,
        side=side,
        label=measure.label_key,
        unit=measure.unit,
        trust=measure.trust,
        trust_key=measure.trust_key,
        better=measure.better,
        points=points,
        difference=change.difference,
        mdc=change.mdc,
        mdc_is_published=measure.mdc is not None,
        verdict=change.verdict,
    )


def _of_side(measure: Measure, side: str, affected_side: str) -> Measure:
    """The healthy arm need not get better; the affected one is measured by the exoskeleton, not by cameras."""
    if not side:
        return measure
    return replace(measure, camera_error=0.0) if side == affected_side else replace(measure, better=Better.NEITHER)
