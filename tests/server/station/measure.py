"""Measure the station on this machine: `python tests/server/station/measure.py RECORDING [SECONDS]`.

A real recording is sent over UDP in real time to the real process; a session is open, and enabled when it may be.
"""

from __future__ import annotations

import asyncio
import shutil
import sys
import tempfile
import time
from collections import Counter
from itertools import pairwise, takewhile
from pathlib import Path

import msgspec
import numpy as np
from mcap.reader import make_reader

from fusion.formats.registry import dialect_named
from fusion.recording.log import TICKS
from fusion.recording.reader import read_recording
from server.experiments.rig.live_station import LiveStation
from server.messages import CloseSession, DriveState, Enable, LiveTick, Resume
from server.sender import Destination, Sender, departures, send_in_time


def _say(name: str, values_s: list[float]) -> None:
    if values_s:
        p50, p99, worst = np.percentile(np.array(values_s) * 1e3, (50, 99, 100))
        print(f"{name:36} p50 {p50:7.2f} ms  p99 {p99:7.2f} ms  max {worst:7.2f} ms")


def _send(recording: Path, port: int, seconds: float) -> None:
    told = read_recording(recording)
    with Sender(Destination("127.0.0.1", port), 2, dialect_named("kinectv2-osc")) as sender:
        send_in_time(takewhile(lambda leaving: leaving.after_s < seconds, departures(told, loop=True)), sender)


async def _keep_going(station: LiveStation) -> None:
    """What a patient therapist does: enable, and resume whenever it may be."""
    while True:
        await asyncio.sleep(0.2)
        tick = station.ticks[-1]
        if tick.blockers:
            continue
        if tick.state is DriveState.READY:
            await station.ask(lambda number: Enable(number=number))
        elif tick.state is DriveState.HOLD:
            await station.ask(lambda number: Resume(number=number))


async def measure(recording: Path, seconds: float) -> None:
    data = Path(tempfile.mkdtemp(prefix="mirrorlimb-data-"))
    path = data / "session.mcap"
    async with LiveStation(data) as station:
        await station.ask(station.session(path))
        therapist = asyncio.create_task(_keep_going(station))
        await asyncio.to_thread(_send, recording, station.port, seconds)
        therapist.cancel()
        await station.ask(lambda number: CloseSession(number=number))
        await asyncio.sleep(0.5)
    report(path, seconds)
    shutil.rmtree(data)


def report(path: Path, seconds: float) -> None:
    decode = msgspec.msgpack.Decoder(LiveTick).decode
    with path.open("rb") as file:
        ticks = [decode(message.data) for _, _, message in make_reader(file).iter_messages(topics=[TICKS])]
    _say("tick to tick", [b.t_s - a.t_s for a, b in pairwise(ticks)])
    _say("work in a tick", [tick.timing.tick_s for tick in ticks])
    _say("datagram to command", [t for tick in ticks if (t := tick.timing.datagram_to_command_s) is not None])
    last = ticks[-1]
    print(f"{len(ticks)} ticks in {last.t_s - ticks[0].t_s:.1f} s, index {ticks[0].index} to {last.index}")
    print("timing at the end:", last.timing)
    print("states:", dict(Counter(tick.state.value for tick in ticks)))
    print("reasons:", Counter(tick.reason for tick in ticks).most_common(8))
    print(
        "blockers while ready or held:",
        Counter(b for t in ticks if t.state != "engaged" for b in t.blockers).most_common(6),
    )
    engaged = [tick for tick in ticks if tick.state is DriveState.ENGAGED]
    if engaged:
        print("first engaged after", f"{engaged[0].t_s - ticks[0].t_s:.1f} s of {seconds:.0f}")
        print("mean speed factor", round(float(np.mean([tick.exo.speed_factor for tick in engaged])), 2))
        both = [t for t in engaged if t.target]
        error = np.array(
            [
                np.subtract(
                    (t.target.plane_rad, t.target.elevation_rad, t.target.rotation_rad, t.target.elbow_rad),
                    t.exo.angle_rad,
                )
                for t in both
            ]
        )
        print("target minus measured, rms rad", np.sqrt((error**2).mean(0)).round(3))


if __name__ == "__main__":
    begun = time.monotonic()
    asyncio.run(measure(Path(sys.argv[1]), float(sys.argv[2]) if len(sys.argv) > 2 else 30.0))
