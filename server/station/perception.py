"""From packets to the pipeline's frame: decoder and pipeline together, renewed where the patient cannot be the same."""

from __future__ import annotations

import logging
from dataclasses import dataclass

from fusion.align.identity import BodyInView
from fusion.formats.decoder import Decoder
from fusion.messages import Packet, PipelineFrame, SkeletonSample
from fusion.pipeline import Pipeline, PipelineSettings
from fusion.skeleton import Side

log = logging.getLogger(__name__)

FORGET_AFTER_S = 60.0
"""After so long a silence sensors may have been moved: what was learnt of them is forgotten."""


@dataclass(frozen=True, slots=True)
class Heard:
    """What one tick's packets said."""

    samples: tuple[SkeletonSample, ...]
    frame: PipelineFrame
    bodies: tuple[BodyInView, ...] = ()
    """Everybody in view."""


class Perception:
    """Everything between datagrams and mirror target; an error in it costs what was learnt, never the loop.

    Args:
        settings: of the pipeline.

    Raises:
        InputError: the fusion method is not known.
    """

    def __init__(self, settings: PipelineSettings) -> None:
        self._settings = settings
        self.healthy_side = settings.healthy_side
        self._pipeline = Pipeline(settings)
        self._last_sample_s: float | None = None
        self.decoder = Decoder()
        self.errors = 0
        """Times that decoder or pipeline failed and were begun anew."""
        self.has_failed = False
        """In the last step; who the patient is has been forgotten with everything else."""

    def treat(self, healthy_side: Side) -> None:
        """A session begins: this arm is the healthy one."""
        self.healthy_side = healthy_side
        self._pipeline.treat(healthy_side)

    def follow(self, sensor: str, body: str) -> bool:
        """A person says which body is the patient; tells whether it is another one than before."""
        return self._pipeline.follow(sensor, body)

    def begin_anew(self) -> None:
        """Forget sensors and body: other sensors send now."""
        self._pipeline = Pipeline(self._settings)
        self._pipeline.treat(self.healthy_side)

    def step(self, packets: list[Packet], now_s: float) -> Heard:
        """Take the tick's packets and say what can be said now."""
        self.has_failed = False
        try:
            samples = self._decoded(packets, now_s)
            self._forget_if_silent(samples, now_s)
            for sample in samples:
                self._pipeline.take(sample)
            return Heard(samples, self._pipeline.step(now_s), self._pipeline.bodies(now_s))
        except Exception:
            log.exception("perception failed and begins anew")
            self.errors, self.has_failed = self.errors + 1, True
            self.decoder = Decoder()
            self.begin_anew()
            return Heard((), PipelineFrame(t_s=now_s, sensors=(), samples=()))

    def _decoded(self, packets: list[Packet], now_s: float) -> tuple[SkeletonSample, ...]:
        samples = [sample for packet in packets for sample in self.decoder.feed(packet)]
        return (*samples, *self.decoder.flush(now_s))

    def _forget_if_silent(self, samples: tuple[SkeletonSample, ...], now_s: float) -> None:
        if not samples:
            return
        if self._last_sample_s is not None and now_s - self._last_sample_s > FORGET_AFTER_S:
            self.begin_anew()
        self._last_sample_s = now_s
