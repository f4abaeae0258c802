"""`replay` over real UDP: what is decoded at the other end is what was recorded."""

import socket
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import islice
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from fusion.errors import InputError, MachineError, RecordingError
from fusion.formats.decoder import Decoder
from fusion.formats.registry import DIALECTS
from fusion.messages import Packet, SkeletonSample
from fusion.recording.reader import Recording, SkeletonStream, read_recording
from fusion.recording.writer import write_recording
from fusion.skeleton import JOINT_COUNT
from server.cli.convert import convert
from server.cli.replay import replay
from server.sender import Destination, Sender, departures, parse_destination, send_in_time

FRAMES = 12


def make(path: Path, frames: int = FRAMES) -> Path:
    """Two sensors at 30 Hz, the second half a frame later and 1 m further away."""
    streams = []
    for k in range(2):
        samples = []
        for n in range(frames):
            positions = np.full((JOINT_COUNT, 3), n / 100) + np.array([0, 0, k + 1])
            t_s = n / 30 + k / 60
            samples.append(SkeletonSample(f"k-{k}", "7", t_s, t_s, positions, np.full(JOINT_COUNT, 2, np.uint8)))
        streams.append(SkeletonStream(f"k-{k}", k == 0, "sensor", tuple(samples)))
    write_recording(Recording("two", "", None, tuple(streams), None, (), path), path)
    return path


@contextmanager
def listening() -> Iterator[tuple[int, list[Packet]]]:
    """A UDP socket read by a thread until half a second after the block."""
    heard: list[Packet] = []
    done = threading.Event()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as channel:
        channel.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 20)
        channel.bind(("127.0.0.1", 0))
        channel.settimeout(0.3)

        def read() -> None:
            while True:
                try:
                    payload, (host, _) = channel.recvfrom(65535)
                except TimeoutError:
                    if done.is_set():
                        return
                    continue
                heard.append(Packet(host, time.monotonic(), payload))

        reader = threading.Thread(target=read)
        reader.start()
        try:
            yield channel.getsockname()[1], heard
        finally:
            done.set()
            reader.join()


@pytest.mark.parametrize("dialect", [dialect.name for dialect in DIALECTS])
@pytest.mark.parametrize("form", ["folder", "log.mcap"])
def test_what_was_recorded_arrives_from_one_address_per_sensor(tmp_path: Path, dialect: str, form: str) -> None:
    path = make(tmp_path / form)
    with listening() as (port, heard):
        replay(path, to=f"127.0.0.1:{port}", dialect=dialect, speed=4.0)
    decoder = Decoder()
    came = [sample for packet in heard for sample in decoder.feed(packet)]
    assert not decoder.counts().refused
    for k, stream in enumerate(read_recording(path).skeleton_streams):
        mine = [sample for sample in came if sample.sensor.split("/")[0] == f"127.0.0.{k + 1}"]
        assert len(mine) == FRAMES
        for sent, got in zip(stream.samples, mine, strict=True):
            assert_allclose(got.positions_in_sensor[0], sent.positions_in_sensor[0], atol=1e-5)


def test_a_replay_takes_as_long_as_the_recording_divided_by_its_speed(tmp_path: Path) -> None:
    recording = read_recording(make(tmp_path / "two"))
    with listening() as (port, _), Sender(Destination("127.0.0.1", port), 2, DIALECTS[2]) as sender:
        start_s = time.monotonic()
        send_in_time(departures(recording), sender, speed=0.5)
        took_s = time.monotonic() - start_s
    assert took_s >= 2 * (FRAMES - 0.5) / 30  # never early; how late is the machine's affair


def test_a_loop_goes_on_in_time(tmp_path: Path) -> None:
    recording = read_recording(make(tmp_path / "two", frames=3))
    leaving = list(islice(departures(recording, loop=True), 18))
    for k in range(2):
        mine = [departure for departure in leaving if departure.sensor == k]
        assert (np.diff([departure.sample.t_s for departure in mine]) > 0.02).all()
        assert (np.diff([departure.after_s for departure in mine]) > 0.02).all()


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("10.0.0.7", Destination("10.0.0.7", 9)),
        ("10.0.0.7:12345", Destination("10.0.0.7", 12345)),
        (":7110", Destination("127.0.0.1", 7110)),
        ("station.local", Destination("station.local", 9)),
    ],
)
def test_destinations(text: str, meant: Destination) -> None:
    assert parse_destination(text, 9) == meant


@pytest.mark.parametrize("text", ["host:", "host:port", "host:0", "host:70000", "a b:1", "::1:5", "1:2:3"])
def test_what_is_no_destination_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="HOST:PORT"):
        parse_destination(text, 9)


def test_an_unknown_host_is_named() -> None:
    with pytest.raises(InputError, match=r"nobody\.invalid"):
        Sender(Destination("nobody.invalid", 9), 1, DIALECTS[0])


def test_too_many_sensors_for_this_machine_are_an_error_of_the_machine() -> None:
    with pytest.raises((MachineError, InputError)):
        Sender(Destination("127.0.0.1", 9), 256, DIALECTS[0])


def test_missing_recordings_and_unknown_dialects_are_named(tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match="nothing does not exist"):
        replay(tmp_path / "nothing")
    with pytest.raises(InputError, match="osceleton2"):
        replay(make(tmp_path / "two"), dialect="kinect")


def test_a_recording_without_frames_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no skeleton frames"):
        replay(make(tmp_path / "two", frames=0))


def test_silence_at_the_other_end_is_noticed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as channel:
        channel.bind(("127.0.0.1", 0))
        free = channel.getsockname()[1]
    replay(make(tmp_path / "two"), to=f":{free}", speed=20.0)
    assert "Nobody listened" in capsys.readouterr().err


def test_convert_goes_both_ways(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    convert(make(tmp_path / "two"), tmp_path / "two.mcap")
    convert(tmp_path / "two.mcap", tmp_path / "again")
    assert f"2 sensors, {2 * FRAMES} frames" in capsys.readouterr().out
    one, other = (read_recording(tmp_path / name).skeleton_streams for name in ("two", "again"))
    for a, b in zip(one, other, strict=True):
        for x, y in zip(a.samples, b.samples, strict=True):
            assert_allclose(x.positions_in_sensor, y.positions_in_sensor)
