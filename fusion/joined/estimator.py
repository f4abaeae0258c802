"""One estimator for all of it: a joint's set is what every camera, the inertial chain, the tag and anatomy leave of it.

Cameras are joined by an estimator of their own (any `Estimator`); its set of each joint is the box that the others cut:

    child = parent + R q b ± tolerance      a bone with an inertial sensor   (`attitude`, `relations`)
    pelvis = tag ± tolerance                                                 (`anchors`)
    least <= |child − parent| <= most       every bone, and across an elbow  (`anatomy`)

Whatever is silent is simply absent: its rule is missing, the sets are wider, and nothing else changes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar, Final

from fusion.estimation.estimator import Estimator
from fusion.joined import anatomy, anchors, relations
from fusion.joined.anatomy import Anatomy
from fusion.joined.anchors import AnchorFrame
from fusion.joined.boxes import Place
from fusion.joined.evidence import Evidence
from fusion.joined.joining import joined
from fusion.joined.relations import Attitudes
from fusion.messages import AlignedSample, FusedFrame, Refusal
from fusion.skeleton import INDEX, TrackingState

LEARN_EVERY_S: Final = 0.1
"""Cameras' errors last for a third of a second: more often tells nothing new."""
PELVIS: Final = INDEX["SpineBase"]


@dataclass(frozen=True, slots=True)
class JoinedState:
    """All that the estimator knows; the log of evidence is no part of it."""

    cameras: object
    attitudes: Attitudes
    anchors: AnchorFrame
    anatomy: Anatomy
    learnt_s: float


class Joined(Estimator):
    """Cameras' estimate cut by inertial sensors, a tag and anatomy.

    Args:
        make: makes the cameras' estimator.
        evidence: the log that inertial and tag samples go into.
        with_anatomy: whether bones and elbows cap the sets; off only to show what they are worth.
    """

    name: ClassVar[str] = "joined"

    def __init__(self, make: Callable[[], Estimator], evidence: Evidence, with_anatomy: bool = True) -> None:
        self._cameras, self._evidence, self._with_anatomy = make(), evidence, with_anatomy
        self._attitudes: Attitudes = {}
        self._anchors, self._anatomy = anchors.unknown(), anatomy.unknown()
        self._learnt_s = float("-inf")

    def update(self, sample: AlignedSample) -> tuple[Refusal, ...]:
        """Take a camera's sample, and learn from it how the other sensors sit."""
        refused = self._cameras.update(sample)
        if sample.t_s >= self._learnt_s + LEARN_EVERY_S:
            self._learn(self._cameras.frame(sample.t_s))
        return refused

    def frame(self, t_s: float) -> FusedFrame:
        """The body at `t_s` from all that was known then."""
        told = self._cameras.frame(t_s)
        offsets = relations.offsets(self._attitudes, self._evidence, t_s)
        limits = anatomy.distances(self._anatomy) if self._with_anatomy else ()
        return joined(told, offsets, self._places(t_s), limits)

    def snapshot(self) -> object:
        """The estimator's state."""
        return JoinedState(self._cameras.snapshot(), self._attitudes, self._anchors, self._anatomy, self._learnt_s)

    def restore(self, snapshot: object) -> None:
        """Go back to an earlier state."""
        if not isinstance(snapshot, JoinedState):
            raise TypeError(f"a snapshot of {self.name} is a JoinedState, not {type(snapshot).__name__}")
        self._cameras.restore(snapshot.cameras)
        self._attitudes, self._anchors, self._anatomy = snapshot.attitudes, snapshot.anchors, snapshot.anatomy
        self._learnt_s = snapshot.learnt_s

    def _learn(self, told: FusedFrame) -> None:
        """Hold the other sensors against the body that cameras alone tell."""
        self._learnt_s = told.t_s
        self._attitudes = relations.learn(self._attitudes, self._evidence, told)
        self._anatomy = anatomy.learn(self._anatomy, told)
        if told.state[PELVIS] == TrackingState.TRACKED:
            lately = self._evidence.tag(told.t_s)
            self._anchors = anchors.learn(self._anchors, told.t_s, told.positions_in_room[PELVIS], lately)

    def _places(self, t_s: float) -> tuple[Place, ...]:
        found = anchors.in_room(self._anchors, self._evidence.tag(t_s), t_s)
        return () if found is None else (Place(PELVIS, found[0], found[1]),)
