"""The station as a process: one per data folder, its parts put together, ended without letting the arm fall."""

from __future__ import annotations

import fcntl
import logging
import logging.handlers
import os
import queue
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from fusion.errors import MachineError
from fusion.pipeline import PipelineSettings
from fusion.skeleton import Side
from fusion.warm import warm
from server.channels import StationChannels
from server.config import StationStart
from server.station import pacemaker
from server.station.demonstration import Demonstration
from server.station.exo.drives import make_drive
from server.station.loop import Loop
from server.station.perception import Perception
from server.station.sources.udp import UdpSource

log = logging.getLogger(__name__)

ORPHAN_S = 5.0
"""A station whose service has gone holds at once (its heartbeat is silent) and ends after this time."""
LEAVE_WITHIN_S = 2.0
VIRTUAL = (
    "from server.station.pacemaker import give_up_priority as first; first(); "
    "from server.station.sources.virtual import main; raise SystemExit(main())"
)
"""The demonstration's sensors: our priority is given up before a second of imports, not after."""
LOOK_EVERY_S = 2.0
LOG_BYTES, LOG_FILES = 1_000_000, 3


def run(start: StationStart) -> None:
    """Run until the service ends it or is gone.

    Raises:
        MirrorlimbError: a port, folder, method or drive cannot be used, or another station has the data folder.
    """
    data, service = Path(start.data), start.service or os.getppid()
    with ExitStack() as stack:
        stack.enter_context(only_one(data))
        stack.enter_context(logging_to(data / "logs" / "realtime.log"))
        config = start.station
        warm(config.method)  # before the sockets: nothing piles up meanwhile, and no tick waits for a compiler
        source = stack.enter_context(UdpSource(config.sensors))
        # Until a session says whose arm is healthy; the demonstration's patient has a healthy right one.
        side = Side.RIGHT if start.demo else Side.LEFT
        perception = Perception(PipelineSettings(side, config.method, config.reference))
        device = make_drive(config.exoskeleton)
        pacemaker.settle()
        # No sooner: 0.14 s of garbage collection at this priority held up another station's loop for 0.11 s. And no
        # later: the threads of the drive, the channels and the recorder need it too.
        real_time = pacemaker.ask_for_priority()
        log.info("real-time priority %s", "granted" if real_time else "not granted")
        drive = stack.enter_context(device)
        channels = StationChannels(Path(start.channels))
        stack.callback(channels.close)
        demonstration = Demonstration() if start.demo else None
        loop = Loop(config, source, perception, drive, channels, demonstration)
        vigil = Vigil(service, loop.lose_service)
        if start.demo:
            vigil.sensors = DemonstrationSensors(start, source.ports)
            stack.callback(vigil.sensors.close)
        loop.announce(time.monotonic(), real_time)
        pacemaker.keep_time(loop.step, loop.count_overruns, config.rate_hz, vigil.goes_on)
        _leave(loop, config.rate_hz)


class Vigil:
    """Watches whether the loop should go on: no signal to end, and the service that started it still there.

    Args:
        service: process number of the service, our parent.
        on_gone: told once, before the next tick begins, that it has gone.
    """

    def __init__(self, service: int, on_gone: Callable[[], None]) -> None:
        self._service, self._on_gone = service, on_gone
        self._gone_s: float | None = None
        self._told_to_end = False
        self.sensors: DemonstrationSensors | None = None
        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, self._end)

    def goes_on(self) -> bool:
        """Asked directly before each tick: a service that died is noticed within one period."""
        if self._told_to_end:
            return False
        if self.sensors is not None:
            self.sensors.look_after()
        if os.getppid() == self._service:
            return True
        if self._gone_s is None:
            self._gone_s = time.monotonic()
            self._on_gone()
            log.error("the service has gone; the arm is held")
        return time.monotonic() - self._gone_s < ORPHAN_S

    def _end(self, *_: object) -> None:
        self._told_to_end = True


def _leave(loop: Loop, rate_hz: int) -> None:
    """Bring the arm to rest and the recording to its end."""
    begun_s = time.monotonic()
    loop.leave(begun_s)
    pacemaker.keep_time(
        loop.step,
        loop.count_overruns,
        rate_hz,
        lambda: not loop.may_end and time.monotonic() - begun_s < LEAVE_WITHIN_S,
    )


@contextmanager
def only_one(data: Path) -> Iterator[None]:
    """Hold the data folder's lock.

    Raises:
        MachineError: another station holds it, or the folder cannot be written.
    """
    path = data / "station.lock"
    try:
        data.mkdir(parents=True, exist_ok=True)
        lock = path.open("a+")
    except OSError as error:
        raise MachineError(
            f"The data folder '{data}' cannot be used: {error.strerror}", "a folder that can be written", "--data"
        ) from None
    with lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            lock.seek(0)
            raise MachineError(
                f"Another station works on the data folder '{data}' (process {lock.read().strip() or 'unknown'})",
                "one station per data folder",
                "end the other one, or choose another folder with --data",
            ) from None
        lock.truncate(0)
        lock.write(str(os.getpid()))
        lock.flush()
        yield


@contextmanager
def logging_to(path: Path) -> Iterator[None]:
    """Log to a file through a queue, so that a slow disk never holds up who logs."""
    path.parent.mkdir(parents=True, exist_ok=True)
    file = logging.handlers.RotatingFileHandler(path, maxBytes=LOG_BYTES, backupCount=LOG_FILES)
    file.setFormatter(logging.Formatter("%(asctime)s %(levelname)s %(name)s: %(message)s"))
    waiting: queue.SimpleQueue[logging.LogRecord] = queue.SimpleQueue()
    listener = logging.handlers.QueueListener(waiting, file)
    handler = logging.handlers.QueueHandler(waiting)
    root = logging.getLogger()
    root.addHandler(handler)
    root.setLevel(logging.INFO)
    listener.start()
    try:
        yield
    finally:
        root.removeHandler(handler)
        listener.stop()
        file.close()


class DemonstrationSensors:
    """The demonstration's sensors, in a process of their own that is started again if it dies.

    Args:
        start: of the station.
        ports: where it listens.
    """

    def __init__(self, start: StationStart, ports: dict[str, int]) -> None:
        port = ports.get("kinectv2-osc") or next(iter(ports.values()))
        module = [sys.executable, "-c", VIRTUAL, "--channels", start.channels]
        options = ["--host", start.station.sensors.bind, "--port", str(port), "--parent", str(os.getpid())]
        self._command = [*module, *options]
        self._process = self._spawn()
        self._looked_s = time.monotonic()

    def look_after(self) -> None:
        """Start them again if they died; looks every two seconds."""
        now_s = time.monotonic()
        if now_s - self._looked_s < LOOK_EVERY_S:
            return
        self._looked_s = now_s
        if self._process.poll() is not None:
            log.error("the demonstration's sensors ended with code %s and are started again", self._process.returncode)
            self._process = self._spawn()

    def close(self) -> None:
        """End them."""
        self._process.terminate()
        self._process.wait(timeout=2.0)

    def _spawn(self) -> subprocess.Popen[bytes]:
        return subprocess.Popen(self._command, stdin=subprocess.DEVNULL)  # noqa: S603 - our own module
