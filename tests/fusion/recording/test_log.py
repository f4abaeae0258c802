"""The live form: what is written is read back, whole or cut off anywhere, also after SIGKILL."""

import os
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from fusion.errors import InputError, MachineError, RecordingError
from fusion.messages import Packet, SkeletonSample
from fusion.recording.log import LogAbout, LogWriter
from fusion.recording.log_reader import LogReader
from fusion.recording.reader import Recording, SkeletonStream, Trouble, TruthStream, read_recording
from fusion.recording.writer import write_recording
from fusion.skeleton import JOINT_COUNT, Side


def sample(number: int, sensor: str = "10.0.0.5") -> SkeletonSample:
    """A body with some joints lost."""
    rng = np.random.default_rng(number)
    state = rng.integers(0, 3, JOINT_COUNT).astype(np.uint8)
    positions = rng.normal(size=(JOINT_COUNT, 3))
    positions[state == 0] = np.nan
    return SkeletonSample(sensor, "3", number / 30, number / 30 + 5.0, positions, state)


def a_recording(path: Path) -> Recording:
    """Two sensors, truth and trouble."""
    streams = tuple(
        SkeletonStream(name, name == "k/2", "sensor", tuple(sample(n, name) for n in range(40)))
        for name in ("k-1", "k/2")
    )
    truth = TruthStream(np.arange(4) / 10 - 0.1, ("Neck", "Head"), np.arange(24.0).reshape(4, 2, 3), "k/2")
    events = (Trouble("k-1", "lost", 0.5, 0.75),)
    return Recording("trial", "made here", Side.LEFT, streams, truth, events, path, origin="a test")


def assert_same(one: Recording, other: Recording, receive_times: bool) -> None:
    """Equal within the folder's tenth of a millimetre."""
    assert (one.name, one.about, one.healthy_side, one.events) == (
        other.name,
        other.about,
        other.healthy_side,
        other.events,
    )
    assert [(s.sensor, s.primary) for s in one.skeleton_streams] == [
        (s.sensor, s.primary) for s in other.skeleton_streams
    ]
    for a, b in zip(one.skeleton_streams, other.skeleton_streams, strict=True):
        for x, y in zip(a.samples, b.samples, strict=True):
            assert (x.sensor, x.body) == (y.sensor, y.body)
            assert x.t_s == pytest.approx(y.t_s, abs=1e-6)
            assert_array_equal(x.state, y.state)
            assert_allclose(x.positions_in_sensor, y.positions_in_sensor, atol=6e-5)
            assert not receive_times or x.t_received_s == y.t_received_s
    assert one.truth is not None
    assert other.truth is not None
    assert (one.truth.joints, one.truth.clock) == (other.truth.joints, other.truth.clock)
    assert_allclose(one.truth.positions, other.truth.positions, atol=6e-5)
    assert_allclose(one.truth.t_s, other.truth.t_s, atol=1e-6)


@pytest.mark.parametrize(("name", "receive_times"), [("log.mcap", True), ("folder", False)])
def test_a_recording_written_in_either_form_is_read_back(tmp_path: Path, name: str, receive_times: bool) -> None:
    recording = a_recording(tmp_path)
    write_recording(recording, tmp_path / name)
    came = read_recording(tmp_path / name)
    assert_same(came, recording, receive_times)


@pytest.mark.parametrize("name", ["log.mcap", "folder"])
def test_samples_read_are_of_the_kind_of_array_that_is_compiled_for(tmp_path: Path, name: str) -> None:
    """Read-only arrays would be another kind, compiled anew on the way."""
    write_recording(a_recording(tmp_path), tmp_path / name)
    for stream in read_recording(tmp_path / name).skeleton_streams:
        for one in stream.samples:
            for array, kind in ((one.positions_in_sensor, np.float64), (one.state, np.uint8)):
                assert array.dtype == kind
                assert array.flags.writeable
                assert array.flags.c_contiguous


@pytest.mark.parametrize("known", [False, True])
def test_a_log_says_whether_it_knows_when_samples_were_received(tmp_path: Path, known: bool) -> None:
    write_recording(replace(a_recording(tmp_path), arrivals_known=known), tmp_path / "log.mcap")
    assert read_recording(tmp_path / "log.mcap").arrivals_known is known
    write_recording(read_recording(tmp_path / "log.mcap"), tmp_path / "folder")
    assert not read_recording(tmp_path / "folder").arrivals_known


def test_what_exists_is_not_overwritten(tmp_path: Path) -> None:
    (tmp_path / "log.mcap").touch()
    with pytest.raises(InputError, match="exists"):
        write_recording(a_recording(tmp_path), tmp_path / "log.mcap")
    with pytest.raises(MachineError, match=r"log\.mcap"):
        LogWriter(tmp_path / "log.mcap", LogAbout("x"))


def test_every_channel_gives_back_what_it_was_given(tmp_path: Path) -> None:
    packet = Packet("10.0.0.5", 1.25, b"\0\xff/osc")
    with LogWriter(tmp_path / "log.mcap", LogAbout("n", healthy_side=Side.RIGHT)) as log:
        log.packet(packet)
        log.tick(b"tick", 2.0)
        log.event(b"event", 3.0)
        log.sample(sample(1))
    reader = LogReader(tmp_path / "log.mcap")
    assert list(reader.packets()) == [packet]
    assert [(entry.t_s, entry.data) for entry in reader.ticks()] == [(2.0, b"tick")]
    assert [(entry.t_s, entry.data) for entry in reader.events()] == [(3.0, b"event")]
    (came,) = reader.samples()
    assert_array_equal(came.positions_in_sensor, sample(1).positions_in_sensor)
    assert came.t_received_s == sample(1).t_received_s
    assert reader.about.healthy_side is Side.RIGHT
    assert reader.is_whole()


def test_a_log_cut_off_anywhere_is_read_up_to_its_last_whole_chunk(tmp_path: Path) -> None:
    whole = tmp_path / "whole.mcap"
    flushed = []
    with LogWriter(whole, LogAbout("n")) as log:
        for second in range(4):
            for number in range(30):
                log.sample(sample(30 * second + number))
            log.flush()
            flushed.append(whole.stat().st_size)
    content = whole.read_bytes()
    for number, length in enumerate(np.linspace(flushed[0], len(content) - 9, 40).astype(int).tolist()):
        cut = tmp_path / f"{number}.mcap"
        cut.write_bytes(content[:length])
        reader = LogReader(cut)
        count = sum(1 for _ in reader.samples())
        assert count >= 30 * sum(size <= length for size in flushed)
        assert not reader.is_whole()
        assert len(read_recording(cut).skeleton_streams[0].samples) == count


def test_most_is_in_the_file_even_before_a_flush(tmp_path: Path) -> None:
    path = tmp_path / "log.mcap"
    with LogWriter(path, LogAbout("n")) as log:
        for number in range(300):
            log.sample(sample(number))
        assert sum(1 for _ in LogReader(path).samples()) > 150


def test_a_straggler_that_repeats_its_frames_time_does_not_spoil_a_folder(tmp_path: Path) -> None:
    twice = (sample(0), sample(0), sample(1))
    stream = SkeletonStream("10.0.0.5", True, "sensor", twice)
    write_recording(Recording("n", "", None, (stream,), None, (), tmp_path), tmp_path / "folder")
    assert len(read_recording(tmp_path / "folder").skeleton_streams[0].samples) == 2


def test_a_spoilt_log_is_read_up_to_the_spoilt_chunk(tmp_path: Path) -> None:
    path = tmp_path / "log.mcap"
    with LogWriter(path, LogAbout("n")) as log:
        for number in range(60):
            log.sample(sample(number))
            if number == 29:
                log.flush()
                flushed = path.stat().st_size
    content = bytearray(path.read_bytes())
    content[flushed + 2000] ^= 0xFF
    path.write_bytes(content)
    assert sum(1 for _ in LogReader(path).samples()) == 30


WRITES_UNTIL_KILLED = """
import sys, numpy as np
from pathlib import Path
from fusion.messages import SkeletonSample
from fusion.recording.log import LogAbout, LogWriter
log = LogWriter(Path(sys.argv[1]), LogAbout("killed"))
number = 0
while True:
    for _ in range(30):
        t_s, seen = float(number), np.full(25, 2, np.uint8)
        log.sample(SkeletonSample("k", "1", t_s, t_s, np.random.rand(25, 3), seen))
        number += 1
    log.flush()
    print(number, flush=True)
    sys.stdin.readline()
"""


def test_after_sigkill_everything_flushed_is_there(tmp_path: Path) -> None:
    path = tmp_path / "killed.mcap"
    process = subprocess.Popen(
        [sys.executable, "-c", WRITES_UNTIL_KILLED, str(path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    with process:
        assert process.stdin is not None
        assert process.stdout is not None
        flushed = 0
        for _ in range(3):
            flushed = int(process.stdout.readline())
            process.stdin.write("\n")
            process.stdin.flush()
        os.kill(process.pid, signal.SIGKILL)
    reader = LogReader(path)
    assert sum(1 for _ in reader.samples()) >= flushed == 90
    assert not reader.is_whole()


@pytest.mark.parametrize("content", [b"", b"hello", b"\x89MCAP0\r\n", b"\x89MCAP0\r\n" + b"\xff" * 99])
def test_what_is_no_log_is_named(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "x.mcap").write_bytes(content)
    with pytest.raises(RecordingError, match=r"x\.mcap is no recording of ours"):
        read_recording(tmp_path / "x.mcap")


@pytest.mark.recordings
def test_a_real_recording_survives_both_forms(recordings: Path, tmp_path: Path) -> None:
    real = read_recording(recordings / "dual-kinect-truth-m10-s02")
    write_recording(real, tmp_path / "log.mcap")
    write_recording(read_recording(tmp_path / "log.mcap"), tmp_path / "folder")
    assert_same(read_recording(tmp_path / "folder"), real, receive_times=False)
