"""Replays recordings through a real service, each as one therapy session, and prints a row for each.

    python examples/replay_all.py RECORDING ... [--keep FOLDER]

For each recording it starts `mirrorlimb serve` on free ports with a data folder of its own, and does over REST what a
therapist does (patient, session, start as soon as it is accepted, resume after a hold, end) while `mirrorlimb replay`
sends the sensors in real time. Every figure is read from what the session itself recorded.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import httpx
import msgspec
import numpy as np

from fusion.recording.log_reader import LogReader
from fusion.recording.reader import read_recording
from server.messages import DriveState, LiveTick, StateChanged

CONFIG = """
port = 0
data = '{data}'
[station.sensors]
ports = {{ kinectv2-osc = 0 }}
"""
MIRRORLIMB = str(Path(sys.executable).with_name("mirrorlimb"))
LOOK_S = 0.25
"""A therapist looks this often whether the arm may be moved."""


@dataclass(frozen=True, slots=True)
class Row:
    """What one session recorded."""

    name: str
    ticks: list[LiveTick]
    changes: list[StateChanged]

    def first_s(self, wanted: str) -> float:
        """From the first datagram to the first tick of the wanted kind; NaN where there is none."""
        kinds = {
            "heard": lambda tick: tick.timing.datagrams > self.ticks[0].timing.datagrams,
            "aligned": lambda tick: sum(sensor.aligned for sensor in tick.sensors) > 1,
            "engaged": lambda tick: tick.state is DriveState.ENGAGED,
        }
        return next((tick.t_s for tick in self.ticks if kinds[wanted](tick)), float("nan"))

    def share(self, state: DriveState) -> float:
        """Share of the ticks from the first engaged one on."""
        states = [tick.state for tick in self.ticks if tick.t_s >= self.first_s("engaged")]
        return states.count(state) / len(states) if states else 0.0

    def text(self) -> str:
        """The row."""
        heard_s = self.first_s("heard")
        delays = [tick.timing.datagram_to_command_s for tick in self.ticks]
        p50, p99 = np.percentile([1e3 * delay for delay in delays if delay is not None] or [np.nan], (50, 99))
        first, last = self.ticks[0].timing, self.ticks[-1].timing
        gap_s = max(b.t_s - a.t_s for a, b in pairwise(self.ticks))
        figures = (
            f"{self.first_s('aligned') - heard_s:7.1f} {self.first_s('engaged') - heard_s:7.1f}",
            f"{self.share(DriveState.ENGAGED):8.0%} {self.share(DriveState.HOLD):5.0%}",
            f"{p50:6.1f} {p99:6.1f} {1e3 * gap_s:6.0f}",
            f"{last.overruns - first.overruns:5d} {last.datagrams_refused - first.datagrams_refused:5d}",
        )
        return f"{self.name:36} {' '.join(figures)}  {self._holds()}"

    def _holds(self) -> str:
        holds = Counter(change.reason for change in self.changes if change.after is DriveState.HOLD)
        resumed = Counter(bool(change.reason) for change in self.changes if change.before is DriveState.HOLD)
        reasons = "; ".join(f"{count} x {reason}" for reason, count in holds.most_common())
        return f"{reasons} ({sum(resumed.values())} resumed)" if holds else "no hold"


HEADER = (
    f"{'recording':36} {'aligned':>7} {'engaged':>7} {'engaged':>8} {'hold':>5} "
    f"{'p50':>6} {'p99':>6} {'gap':>6} {'late':>5} {'refus':>5}  holds\n"
    f"{'':36} {'s':>7} {'s':>7} {'share':>8} {'share':>5} {'ms':>6} {'ms':>6} {'ms':>6}"
)


@contextmanager
def service(data: Path) -> Iterator[httpx.Client]:
    """A running service, and a client that is logged in to it."""
    data.mkdir(parents=True, exist_ok=True)
    config = data / "serve.toml"
    config.write_text(CONFIG.format(data=data))
    command = [MIRRORLIMB, "serve", "--config", str(config)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:  # noqa: S603 (our own command)
        try:
            address = process.stdout.readline().strip() if process.stdout else ""
            if not address:
                sys.exit("The service could not start; it said why above.")
            with httpx.Client(base_url=f"{address}/api", timeout=30) as client:
                client.post("/setup", json={"name": "Dr. Lin", "password": "three quiet herons"}).raise_for_status()
                yield client
        finally:
            process.terminate()


def play(client: httpx.Client, path: Path, data: Path) -> Row:
    """One session with one recording."""
    recording = read_recording(path)
    port = client.get("/station").json()["ports"]["kinectv2-osc"]
    patient = {"name": recording.name, "healthy_side": recording.healthy_side.value}
    patient_id = client.post("/patients", json=patient).raise_for_status().json()["id"]
    opening = {"patient_id": patient_id, "confirmed_affected_side": recording.healthy_side.other.value}
    number = client.post("/sessions", json=opening).raise_for_status().json()["id"]
    command = [MIRRORLIMB, "replay", str(path), "--to", f"127.0.0.1:{port}", "--dialect", "kinectv2-osc"]
    with subprocess.Popen(command, stderr=subprocess.DEVNULL) as sending:  # noqa: S603 (our own command)
        while sending.poll() is None:
            attend(client, number)
            time.sleep(LOOK_S)
    client.post(f"/sessions/{number}/end", json={}).raise_for_status()
    return read_row(recording.name, next(data.rglob("*.mcap")))


def attend(client: httpx.Client, number: int) -> None:
    """What a therapist does: start and resume as soon as it is accepted; a refusal is asked again."""
    wanted = {"ready": "start", "hold": "resume"}.get(client.get("/station").json()["state"])
    if wanted:
        client.post(f"/sessions/{number}/control", json={"action": wanted})


def read_row(name: str, path: Path) -> Row:
    """What a session recorded."""
    log = LogReader(path)
    ticks = [msgspec.msgpack.decode(entry.data, type=LiveTick) for entry in log.ticks()]
    events = [msgspec.msgpack.decode(entry.data) for entry in log.events()]
    changes = [msgspec.convert(event, StateChanged) for event in events if event["kind"] == "state"]
    return Row(name, ticks, changes)


def main() -> None:
    """Play every recording named on the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recordings", nargs="+", type=Path)
    parser.add_argument("--keep", type=Path, help="data folder; otherwise a temporary one")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        data = options.keep or Path(temporary)
        print(HEADER, flush=True)
        for path in options.recordings:
            # A service each: another recording is another room, and what was learnt of its sensors would not hold.
            with service(data / path.name) as client:
                print(play(client, path, data / path.name).text(), flush=True)


if __name__ == "__main__":
    main()
