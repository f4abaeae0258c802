"""The recorder never holds up who records; what it cannot write is counted."""

from __future__ import annotations

import threading
from pathlib import Path

import pytest

from fusion.errors import MachineError
from fusion.messages import Packet
from fusion.recording.log import LogAbout, LogWriter
from fusion.recording.log_reader import LogReader
from server.station.recorder import Recorder


def _packet(number: int) -> Packet:
    return Packet("s", float(number), b"x" * 100)


def test_sr9_a_disk_that_stands_still_costs_entries_and_never_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    gate = threading.Event()
    real = LogWriter.packet

    def slow(writer: LogWriter, packet: Packet) -> None:
        gate.wait(10)
        real(writer, packet)

    monkeypatch.setattr(LogWriter, "packet", slow)
    recorder = Recorder(tmp_path / "r.mcap", LogAbout("r"), entries_kept=100)
    for number in range(500):
        recorder.packet(_packet(number))
    assert recorder.dropped >= 399
    gate.set()
    recorder.close()
    assert recorder.finished


def test_sr8_a_full_disk_is_told_in_words_and_counted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(LogWriter, "packet", full)
    recorder = Recorder(tmp_path / "r.mcap", LogAbout("r"))
    for number in range(10):
        recorder.packet(_packet(number))
    recorder.close()
    assert recorder.dropped == 10
    assert "r.mcap" in recorder.trouble
    assert "No space left" in recorder.trouble


def test_what_comes_after_the_end_is_neither_written_nor_waited_for(tmp_path: Path) -> None:
    recorder = Recorder(tmp_path / "r.mcap", LogAbout("r"))
    recorder.packet(_packet(0))
    recorder.finish()
    while not recorder.finished:
        recorder.packet(_packet(1))  # a loop that goes on meanwhile
    recorder.finish()
    assert recorder.dropped == 0
    assert sum(1 for _ in LogReader(tmp_path / "r.mcap").packets()) == 1


def test_a_file_that_is_there_already_is_never_overwritten(tmp_path: Path) -> None:
    (tmp_path / "r.mcap").write_bytes(b"precious")
    with pytest.raises(MachineError, match=r"r\.mcap"):
        Recorder(tmp_path / "r.mcap", LogAbout("r"))
    assert (tmp_path / "r.mcap").read_bytes() == b"precious"
