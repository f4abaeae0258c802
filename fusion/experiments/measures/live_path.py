"""The way from a sensor's frame to a fused frame, timed: encoded, sent over a wire, decoded, fused."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Final

import numpy as np

from fusion.experiments.wire import Wire
from fusion.formats.decoder import Decoder
from fusion.formats.registry import dialect_named
from fusion.messages import Floats, Packet, SkeletonSample
from fusion.pipeline import Pipeline, PipelineSettings
from fusion.recording.recording import Recording
from fusion.skeleton import Side

DIALECT: Final = "kinectv2-osc"


@dataclass(frozen=True, slots=True)
class Timed:
    """N frames, in milliseconds."""

    network_ms: Floats  # (N,) all datagrams of a frame sent and received
    decode_ms: Floats  # (N,)
    fuse_ms: Floats  # (N,) taken and told
    interval_ms: Floats  # (N - 1,) between fused frames that two frames of the same sensor led to


def timed(recording: Recording, wire: Wire, method: str) -> Timed:
    """Play a recording in real time through the wire; every sensor frame leads to a fused frame.

    Args:
        recording: whose sensors' clocks are close to one another.
        wire: carries the datagrams.
        method: a name in `fusion.estimation.METHODS`.
    """
    due = sorted((s for stream in recording.skeleton_streams for s in stream.samples), key=lambda s: s.t_received_s)
    dialect, decoder = dialect_named(DIALECT), Decoder()
    pipeline = Pipeline(PipelineSettings(recording.healthy_side or Side.RIGHT, method))
    begun_s = time.perf_counter() - due[0].t_received_s
    costs, told_s = [], {stream.sensor: list[float]() for stream in recording.skeleton_streams}
    for number, sample in enumerate(due):
        payloads = dialect.encode(sample, number)
        time.sleep(max(0.0, begun_s + sample.t_received_s - time.perf_counter()))
        costs.append(_one_frame(sample, payloads, wire, decoder, pipeline))
        told_s[sample.sensor].append(time.perf_counter())
    network, decode, fuse = 1e3 * np.array(costs).T
    intervals = np.concatenate([np.diff(each) for each in told_s.values()])
    return Timed(network, decode, fuse, 1e3 * intervals)


def _one_frame(
    sample: SkeletonSample, payloads: list[bytes], wire: Wire, decoder: Decoder, pipeline: Pipeline
) -> tuple[float, float, float]:
    """Seconds that the network, the decoder and the fusion took."""
    started = time.perf_counter()
    for payload in payloads:
        wire.send(payload)
    received = [wire.receive() for _ in payloads]
    arrived = time.perf_counter()
    samples = [found for payload in received for found in decoder.feed(Packet(sample.sensor, arrived, payload))]
    decoded = time.perf_counter()
    for found in samples:
        pipeline.take(found)
    pipeline.step(decoded)
    return arrived - started, decoded - arrived, time.perf_counter() - decoded
